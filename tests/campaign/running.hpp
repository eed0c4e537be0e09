// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace limpet::campaign {

/// The program at work in the background, until it is killed or waited for.
class Running {
public:
    /// @param launcher  words before the program's own, as of mpirun
    Running(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
            const std::vector<std::string>& launcher = {});
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    void signal(int number) const;
    /// @return exit code, or minus the signal that ended it
    int wait();

private:
    pid_t child_ = 0;
};

/// Waits up to half a minute. @return whether it came true
[[nodiscard]] bool eventually(const std::function<bool()>& happened);

}  // namespace limpet::campaign
