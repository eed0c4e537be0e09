// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace limpet {

/// Keeps a second flight or campaign out of a folder for as long as it lives; ends with the
/// process, however that ends, and leaves no file behind.
class FolderLock {
public:
    /// @throws InputError when another process holds it
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int descriptor_;
};

}  // namespace limpet
