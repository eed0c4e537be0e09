// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::ros2 {

/// A node's process; ends with this.
class Process {
public:
    Process(const std::string& program, std::vector<std::string> parameters) {
        std::vector<std::string> words = {program, "--ros-args"};
        for (std::string& parameter : parameters) {
            words.insert(words.end(), {"-p", std::move(parameter)});
        }
        std::vector<char*> arguments;
        for (std::string& word : words) {
            arguments.push_back(word.data());
        }
        arguments.push_back(nullptr);
        const std::string path = std::string(LIMPET_ROS2_NODES) + "/" + program;
        require(posix_spawn(&id_, path.c_str(), nullptr, nullptr, arguments.data(), environ) == 0,
                "a node starts");
    }
    ~Process() { static_cast<void>(end()); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// @return its exit code after Ctrl-C, -1 when it did not end well
    int end() {
        if (id_ == 0) {
            return -1;
        }
        kill(id_, SIGINT);
        return wait();
    }
    /// @return its exit code once it has ended by itself
    int wait() {
        int status = 0;
        waitpid(std::exchange(id_, 0), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    pid_t id_ = 0;
};

}  // namespace limpet::ros2
