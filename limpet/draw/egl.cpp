// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/egl.hpp"

#include <fmt/format.h>

#include "limpet/core/errors.hpp"
#include "limpet/loaded/library.hpp"

namespace limpet::draw {

Egl::Egl(const std::string& file) try {
    const loaded::Library library(file);
    library.take(eglBindAPI, "eglBindAPI");
    library.take(eglChooseConfig, "eglChooseConfig");
    library.take(eglCreateContext, "eglCreateContext");
    library.take(eglDestroyContext, "eglDestroyContext");
    library.take(eglGetError, "eglGetError");
    library.take(eglGetProcAddress, "eglGetProcAddress");
    library.take(eglInitialize, "eglInitialize");
    library.take(eglMakeCurrent, "eglMakeCurrent");
} catch (const NotInstalled& problem) {
    throw NotInstalled(
        fmt::format("EGL is not there, which pictures of the vehicle need (apt-get install libegl1 "
                    "libgl1-mesa-dri): {}",
                    problem.what()));
}

const Egl& egl() {
    static const Egl loaded("libEGL.so.1");
    return loaded;
}

}  // namespace limpet::draw
