// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/offscreen.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <string>

#include "limpet/core/errors.hpp"
#include "limpet/loaded/library.hpp"

namespace limpet::draw {
namespace {

/// What we use of EGL, under its own names and with the types of its header.
struct Egl {
    /// @throws NotInstalled naming the packages
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

/// EGL, loaded by the first call. From any thread.
const Egl& egl() {
    static const Egl loaded("libEGL.so.1");
    return loaded;
}

[[noreturn]] void give_up(const char* what) {
    throw NotInstalled(
        fmt::format("cannot draw without a screen: {} (EGL error {:#x}); needed: "
                    "apt-get install libegl1 libgl1-mesa-dri",
                    what, egl().eglGetError()));
}

/// A display that is no device and no window system.
EGLDisplay surfaceless_display() {
    const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        egl().eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display == nullptr) {
        return EGL_NO_DISPLAY;
    }
    return get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

}  // namespace

void require_egl() {
    (void)egl();
}

OffscreenContext::OffscreenContext() : display_(surfaceless_display()) {
    if (display_ == EGL_NO_DISPLAY || egl().eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) {
        give_up("no surfaceless EGL display");
    }
    // MuJoCo draws into buffers of its own, with OpenGL's compatibility profile.
    constexpr EGLint kWanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (egl().eglChooseConfig(display_, kWanted, &config, 1, &found) != EGL_TRUE || found == 0) {
        give_up("no EGL configuration for OpenGL");
    }
    egl().eglBindAPI(EGL_OPENGL_API);
    context_ = egl().eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) {
        give_up("no OpenGL context");
    }
    if (!use()) {
        give_up("no OpenGL context without a surface");
    }
}

bool OffscreenContext::use() noexcept {
    return egl().eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
}

OffscreenContext::~OffscreenContext() {
    egl().eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl().eglDestroyContext(display_, context_);
    // The display is the process's: ending it here would take it from every other context.
}

}  // namespace limpet::draw
