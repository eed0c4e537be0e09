// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/mjcf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "limpet/core/errors.hpp"
#include "limpet/core/one_line.hpp"
#include "limpet/draw/picture_model.hpp"

namespace limpet::draw {
namespace {

using loaded::mujoco;

/// Files that MuJoCo finds in memory.
class Files {
public:
    Files() { mujoco().mj_defaultVFS(files_.get()); }
    ~Files() { mujoco().mj_deleteVFS(files_.get()); }
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;

    [[nodiscard]] mjVFS* get() const { return files_.get(); }
    /// @return whether it was taken
    [[nodiscard]] bool add(const char* name, const std::string& text) const {
        if (mujoco().mj_makeEmptyFileVFS(get(), name, static_cast<int>(text.size())) != 0) {
            return false;
        }
        std::memcpy(files_->filedata[mujoco().mj_findFileVFS(get(), name)], text.data(),
                    text.size());
        return true;
    }

private:
    std::unique_ptr<mjVFS> files_ = std::make_unique<mjVFS>();
};

}  // namespace

MujocoModel compile_mjcf(const std::string& mjcf) {
    constexpr const char* kName = "model.xml";
    const Files files;
    if (!files.add(kName, picture_model(mjcf))) {
        throw InputError("model.xml: too large");
    }
    char message[1000] = "";
    MujocoModel model(mujoco().mj_loadXML(kName, files.get(), message, sizeof message));
    if (!model) {
        throw InputError(fmt::format("model.xml: {}", one_line(message)));
    }
    return model;
}

}  // namespace limpet::draw
