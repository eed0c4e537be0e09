// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <EGL/egl.h>

#include <string>

namespace limpet::draw {

/// What we use of EGL, under its own names and with the types of its header.
struct Egl {
    /// @throws NotInstalled the loader's words
    explicit Egl(const std::string& file);

    decltype(&::eglBindAPI) eglBindAPI = nullptr;
    decltype(&::eglChooseConfig) eglChooseConfig = nullptr;
    decltype(&::eglCreateContext) eglCreateContext = nullptr;
    decltype(&::eglDestroyContext) eglDestroyContext = nullptr;
    decltype(&::eglGetError) eglGetError = nullptr;
    decltype(&::eglGetProcAddress) eglGetProcAddress = nullptr;
    decltype(&::eglInitialize) eglInitialize = nullptr;
    decltype(&::eglMakeCurrent) eglMakeCurrent = nullptr;
};

/// EGL, loaded by who first asks. From any thread.
/// @throws NotInstalled naming the packages when it is not there
[[nodiscard]] const Egl& egl();

}  // namespace limpet::draw
