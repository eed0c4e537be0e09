// SPDX-License-Identifier: Apache-2.0
#include "limpet/loaded/library.hpp"

#include <dlfcn.h>

#include "limpet/core/errors.hpp"

namespace limpet::loaded {

Library::Library(const std::string& file)
    : file_(file), handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) {
        throw NotInstalled(dlerror());
    }
}

void* Library::symbol(const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr) {
        throw NotInstalled(file_ + ": has no " + name);
    }
    return found;
}

}  // namespace limpet::loaded
