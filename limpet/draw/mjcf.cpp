// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/mjcf.hpp"

#include <fmt/format.h>

#include <cstring>

#include "limpet/core/errors.hpp"

namespace limpet::draw {

MujocoModel compile_mjcf(const std::string& mjcf) {
    constexpr const char* kName = "model.xml";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    if (mjcf.empty() ||
        mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(mjcf.size())) != 0) {
        throw InputError("model.xml: empty, or too large");
    }
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), kName)], mjcf.data(), mjcf.size());
    char message[1000] = "";
    MujocoModel model(mj_loadXML(kName, files.get(), message, sizeof message));
    mj_deleteVFS(files.get());
    if (!model) {
        throw InputError(fmt::format("model.xml: {}", message));
    }
    return model;
}

}  // namespace limpet::draw
