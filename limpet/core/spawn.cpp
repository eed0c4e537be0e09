// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/spawn.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <system_error>

extern "C" {
// Of glibc 2.34; a program that was linked with an older one finds it where it runs.
[[gnu::weak]] int posix_spawn_file_actions_addclosefrom_np(posix_spawn_file_actions_t*,
                                                           int) noexcept;
}

namespace limpet {
namespace {

constexpr int kFirstOfOurs = STDERR_FILENO + 1;

/// Those that are open now: what is opened between this and the start is closed by its own
/// FD_CLOEXEC alone.
void close_one_by_one(posix_spawn_file_actions_t& actions) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", ignored)) {
        const std::string name = entry.path().filename().string();
        int descriptor = 0;
        std::from_chars(name.data(), name.data() + name.size(), descriptor);
        if (descriptor >= kFirstOfOurs) {
            posix_spawn_file_actions_addclose(&actions, descriptor);
        }
    }
}

/// posix_spawn()'s own memory, for as long as it is needed.
class Actions {
public:
    explicit Actions(const Program& program) {
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
        if (program.input) {
            posix_spawn_file_actions_adddup2(&files, *program.input, STDIN_FILENO);
        } else {
            posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        }
        write(STDOUT_FILENO, program.output);
        if (program.errors.empty()) {
            posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
        } else {
            write(STDERR_FILENO, program.errors);
        }
        if (!program.folder.empty()) {
            posix_spawn_file_actions_addchdir_np(&files, program.folder.c_str());
        }
        if (posix_spawn_file_actions_addclosefrom_np != nullptr) {
            posix_spawn_file_actions_addclosefrom_np(&files, kFirstOfOurs);
        } else {
            close_one_by_one(files);
        }
        if (program.own_group) {
            posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
            posix_spawnattr_setpgroup(&attributes, 0);
        }
    }
    ~Actions() {
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&files);
    }
    Actions(const Actions&) = delete;
    Actions& operator=(const Actions&) = delete;

    posix_spawn_file_actions_t files{};
    posix_spawnattr_t attributes{};

private:
    void write(int descriptor, const std::filesystem::path& file) {
        posix_spawn_file_actions_addopen(&files, descriptor, file.c_str(),
                                         O_WRONLY | O_CREAT | O_TRUNC, 0600);
    }
};

}  // namespace

Spawned spawn(const Program& program) {
    std::vector<std::string> words = program.words;
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    const Actions actions(program);
    Spawned spawned;
    spawned.error = posix_spawnp(&spawned.id, arguments.front(), &actions.files,
                                 &actions.attributes, arguments.data(), environ);
    spawned.id = spawned.error == 0 ? spawned.id : 0;
    return spawned;
}

int wait_for(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) {
            return -1;
        }
    }
    return status;
}

}  // namespace limpet
