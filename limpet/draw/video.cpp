// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/video.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/spawn.hpp"

namespace limpet::draw {
namespace {

/// What makes a film that every browser shows, of either kind.
std::vector<std::string> coder_of(const std::filesystem::path& file) {
    if (file.extension() == ".webm") {
        return {"-c:v", "libvpx-vp9", "-crf",     "34",        "-b:v",
                "0",    "-deadline",  "realtime", "-cpu-used", "5"};
    }
    return {"-c:v", "libx264", "-crf", "22", "-preset", "medium", "-movflags", "+faststart"};
}

constexpr const char* kNone = "ffmpeg is not installed (apt-get install ffmpeg)";

}  // namespace

void require_ffmpeg() {
    const char* given = std::getenv("PATH");
    std::istringstream folders(given != nullptr ? given : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path program = std::filesystem::path(folder) / "ffmpeg";
        if (is_file(program) && access(program.c_str(), X_OK) == 0) {
            return;
        }
    }
    throw NotInstalled(kNone);
}

Video::Video(const std::filesystem::path& file, int width_px, int height_px, int frames_a_second)
    : log_(file.string() + ".log"), width_px_(width_px), height_px_(height_px) {
    std::vector<std::string> words = {"ffmpeg",
                                      "-hide_banner",
                                      "-loglevel",
                                      "error",
                                      "-y",
                                      "-f",
                                      "rawvideo",
                                      "-pix_fmt",
                                      "rgb24",
                                      "-s",
                                      fmt::format("{}x{}", width_px, height_px),
                                      "-r",
                                      std::to_string(frames_a_second),
                                      "-i",
                                      "pipe:0"};
    const std::vector<std::string> coder = coder_of(file);
    words.insert(words.end(), coder.begin(), coder.end());
    for (const char* word : {"-pix_fmt", "yuv420p", "-threads", "2", "-fflags", "+bitexact",
                             "-flags:v", "+bitexact"}) {
        words.emplace_back(word);
    }
    words.push_back(file.string());

    // A socket, not a pipe: a write into one without a reader can be kept from raising a signal.
    int ends[2] = {-1, -1};
    require(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0, "two ends of a socket");
    const auto [child, problem] =
        spawn({.words = words, .input = ends[1], .errors = log_, .own_group = true});
    child_ = child;
    close(ends[1]);
    to_ffmpeg_ = ends[0];
    if (problem != 0) {
        close(to_ffmpeg_);
        if (problem == ENOENT || problem == EACCES) {
            throw NotInstalled(kNone);
        }
        throw InputError(fmt::format("ffmpeg cannot be started: {}", std::strerror(problem)));
    }
}

Video::~Video() {
    if (child_ != 0) {
        kill(child_, SIGKILL);
        end();
    }
}

/// @return the status of waitpid()
int Video::end() {
    close(to_ffmpeg_);
    const int status = wait_for(child_);
    child_ = 0;
    return status;
}

void Video::fail() {
    std::ifstream file(log_);
    std::string words{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    words.resize(words.find_last_not_of('\n') + 1);
    throw InputError("ffmpeg: " + (words.empty() ? "ended before the film did" : words));
}

void Video::add(const Image& image) {
    require(image.width_px == width_px_ && image.height_px == height_px_,
            "every frame is of the film's size");
    for (std::size_t done = 0; done < image.rgb.size();) {
        const ssize_t sent =
            send(to_ffmpeg_, image.rgb.data() + done, image.rgb.size() - done, MSG_NOSIGNAL);
        if (sent < 0 && errno != EINTR) {
            end();
            fail();
        }
        done += sent > 0 ? static_cast<std::size_t>(sent) : 0;
    }
}

void Video::finish() {
    const int status = end();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        fail();
    }
    std::error_code ignored;
    std::filesystem::remove(log_, ignored);
}

}  // namespace limpet::draw
