// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "limpet/core/errors.hpp"

namespace limpet {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
        throw InputError(folder.string() + ": is not a folder that can be used");
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        close(descriptor_);
        throw InputError(folder.string() +
                         ": another flight or campaign is at work in this folder");
    }
}

FolderLock::~FolderLock() {
    close(descriptor_);
}

}  // namespace limpet
