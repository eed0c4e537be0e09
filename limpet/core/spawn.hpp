// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace limpet {

/// A program to be started, and what it has of ours: three descriptors, nothing else.
struct Program {
    std::vector<std::string> words;              ///< its name, looked up in PATH, and arguments
    std::filesystem::path folder = {};           ///< it runs there; where we do if empty
    std::optional<int> input = {};               ///< descriptor that it reads; else nothing
    std::filesystem::path output = "/dev/null";  ///< written over
    std::filesystem::path errors = {};           ///< written over; with its output if empty
    bool own_group = false;                      ///< Ctrl-C is for us alone, which end it
};

/// A process, or why there is none.
struct Spawned {
    pid_t id = 0;   ///< 0: none
    int error = 0;  ///< as errno; ENOENT, EACCES: no such program
};

/// Starts a program. The only place that does: a socket that another thread has just opened is not
/// inherited, so that its port is free once that thread has closed it.
[[nodiscard]] Spawned spawn(const Program& program);

/// Waits for the end of a process that was started.
/// @return as waitpid() gives it; -1, which is neither an exit nor a signal, where it was nobody's
int wait_for(pid_t process);

}  // namespace limpet
