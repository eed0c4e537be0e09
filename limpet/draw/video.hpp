// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "limpet/draw/stage.hpp"

namespace limpet::draw {

/// Checks before the pictures of a film are drawn, which takes minutes.
/// @throws NotInstalled where there is no ffmpeg on the PATH
void require_ffmpeg();

/// A film by ffmpeg, a program: .mp4 (H.264) or .webm (VP9), by the file's name. The same pictures
/// make the same bytes. It runs as long as this; one that is not finished is ended.
class Video {
public:
    /// @param file  is written over
    /// @throws NotInstalled where there is no ffmpeg
    Video(const std::filesystem::path& file, int width_px, int height_px, int frames_a_second);
    ~Video();
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    /// @param image  of the film's size
    /// @throws InputError with ffmpeg's words when it takes no more
    void add(const Image& image);
    /// @throws InputError with ffmpeg's words when there is no whole film
    void finish();

private:
    [[noreturn]] void fail();
    int end();

    std::filesystem::path log_;
    int width_px_;
    int height_px_;
    int to_ffmpeg_ = -1;
    pid_t child_ = 0;
};

}  // namespace limpet::draw
