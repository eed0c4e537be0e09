// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpet/core/folder_lock.hpp"
#include "limpet/px4/airframe.hpp"
#include "limpet/px4/instance.hpp"

namespace limpet::px4 {

/// A PX4 as a process of ours, in a folder of its own that nothing is left of but what is kept; it
/// does not outlive us. PX4 never reconnects once its simulator has gone: a process a flight.
/// Folders of processes that were killed go with the next one.
class Px4Process {
public:
    /// @param start  the folder of a PX4 built for simulation (bin/px4, etc), which then flies
    ///               `airframe`; or a command line for sh, in which {instance} stands for the
    ///               instance's number and {folder} for an empty folder of this process alone,
    ///               which holds the airframe's .params
    /// @throws InputError when it cannot be started, or PX4 has no such parameter
    Px4Process(const std::string& start, const Px4Airframe& airframe, const Px4Instance& instance);
    /// Ends it, and what it has started.
    ~Px4Process();
    Px4Process(const Px4Process&) = delete;
    Px4Process& operator=(const Px4Process&) = delete;

    /// @throws InputError with its last line when it has ended by itself
    void require_running();
    /// Ends it, and keeps what it has written: its console as px4.log, its own logs in their order
    /// as px4.ulg, px4_2.ulg, ...; such files of an earlier flight go.
    /// @param folder  is there
    /// @return what was kept
    /// @throws InputError when it cannot be written
    std::vector<std::filesystem::path> keep(const std::filesystem::path& folder);
    /// Parameters that this PX4 has no more, as far as its build tells.
    [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }
    /// What runs, for people.
    [[nodiscard]] const std::string& command() const { return command_; }

private:
    class Folder {
    public:
        Folder();
        ~Folder();
        Folder(const Folder&) = delete;
        Folder& operator=(const Folder&) = delete;
        std::filesystem::path path;

    private:
        std::optional<FolderLock> lock_;  ///< says that somebody is at work in it
    };
    void end();

    Folder folder_;
    std::string command_;
    std::vector<std::string> left_out_;
    pid_t child_ = 0;
};

}  // namespace limpet::px4
