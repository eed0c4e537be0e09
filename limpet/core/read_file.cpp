// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

class OpenFile {
public:
    explicit OpenFile(const std::filesystem::path& path)
        : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~OpenFile() {
        if (descriptor_ >= 0) {
            close(descriptor_);
        }
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
    [[nodiscard]] struct stat status() const {
        struct stat status {};
        (void)fstat(descriptor_, &status);
        return status;
    }
    /// @return bytes read, 0 at the end, negative with errno
    [[nodiscard]] ssize_t read_some(char* to, std::size_t most) const {
        return read(descriptor_, to, most);
    }

private:
    int descriptor_;
};

}  // namespace

std::string read_file(const std::filesystem::path& path, const FileBound& bound,
                      const std::string& shown) {
    const auto cannot = [&shown](int why) {
        if (why == EINTR) {  // a pipe that nobody fills
            throw Interrupted("interrupted while reading " + shown);
        }
        return InputError(shown + ": cannot be read: " + std::strerror(why));
    };
    const OpenFile file(path);
    if (!file.is_open()) {
        throw cannot(errno);
    }
    const struct stat status = file.status();
    if (S_ISDIR(status.st_mode)) {
        throw InputError(shown + ": is a directory, not a file");
    }
    const std::size_t most = bound.most_MB * 1'000'000;
    const auto stated = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
    std::string text;
    if (stated <= most) {
        text.reserve(stated);
        std::array<char, 65536> part;
        for (ssize_t count = 1; count > 0 && text.size() <= most;) {
            count = file.read_some(part.data(), part.size());
            if (count < 0) {
                throw cannot(errno);
            }
            text.append(part.data(), static_cast<std::size_t>(count));
        }
    }
    if (stated > most || text.size() > most) {
        throw InputError(shown + ": is larger than " + std::to_string(bound.most_MB) +
                         " MB, which no " + std::string(bound.what) + " is");
    }
    return text;
}

std::string read_file(const std::filesystem::path& path, const FileBound& bound) {
    return read_file(path, bound, path.string());
}

}  // namespace limpet
