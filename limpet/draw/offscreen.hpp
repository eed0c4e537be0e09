// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet::draw {

/// Loads EGL where that has not been done.
/// @throws NotInstalled naming the packages when it is not there
void require_egl();

/// OpenGL without a screen: an EGL context, in use on the thread that made it. Mesa's software
/// renderer will do; no display server and no graphics card are needed.
class OffscreenContext {
public:
    /// @throws InputError naming what to install when there is no way to draw
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Makes it the one that the calling thread draws with.
    /// @return whether it is the one that is drawn into now
    [[nodiscard]] bool use() noexcept;

private:
    void* display_ = nullptr;  // EGLDisplay and EGLContext, without their header
    void* context_ = nullptr;
};

}  // namespace limpet::draw
