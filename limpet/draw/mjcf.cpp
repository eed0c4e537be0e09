// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/mjcf.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "limpet/core/errors.hpp"

namespace limpet::draw {
namespace {

using loaded::mujoco;

/// An attribute `file`, `fileup`...: MuJoCo would read whatever it is told to.
bool names_a_file(const std::string& mjcf) {
    constexpr std::string_view kBlanks = " \t\r\n\"'/";
    for (std::size_t at = mjcf.find("file"); at != mjcf.npos; at = mjcf.find("file", at + 1)) {
        const std::size_t end = mjcf.find_first_not_of("abcdefghijklmnopqrstuvwxyz", at);
        const std::size_t sign = mjcf.find_first_not_of(" \t\r\n", end);
        if (at > 0 && kBlanks.find(mjcf[at - 1]) != kBlanks.npos && sign != mjcf.npos &&
            mjcf[sign] == '=') {
            return true;
        }
    }
    return false;
}

}  // namespace

MujocoModel compile_mjcf(const std::string& mjcf) {
    constexpr const char* kName = "model.xml";
    const auto files = std::make_unique<mjVFS>();
    mujoco().mj_defaultVFS(files.get());
    if (names_a_file(mjcf)) {
        throw InputError("model.xml: names a file, which the model of a recording does not");
    }
    if (mjcf.empty() ||
        mujoco().mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(mjcf.size())) != 0) {
        throw InputError("model.xml: empty, or too large");
    }
    std::memcpy(files->filedata[mujoco().mj_findFileVFS(files.get(), kName)], mjcf.data(),
                mjcf.size());
    char message[1000] = "";
    MujocoModel model(mujoco().mj_loadXML(kName, files.get(), message, sizeof message));
    mujoco().mj_deleteVFS(files.get());
    if (!model) {
        throw InputError(fmt::format("model.xml: {}", message));
    }
    return model;
}

}  // namespace limpet::draw
