// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/core/words.hpp"
#include "limpet/meshes/readers.hpp"

namespace limpet::meshes {

namespace {

enum class PlyForm {
    ascii,
    little,
    big
};

/// How a number lies in a binary file.
struct PlyType {
    std::string_view name;
    std::string_view other_name;
    std::size_t bytes;
    double (*read)(const char* bytes);
};

template <class Number>
double number_at(const char* bytes) {
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

constexpr PlyType kPlyTypes[] = {{"char", "int8", 1, number_at<std::int8_t>},
                                 {"uchar", "uint8", 1, number_at<std::uint8_t>},
                                 {"short", "int16", 2, number_at<std::int16_t>},
                                 {"ushort", "uint16", 2, number_at<std::uint16_t>},
                                 {"int", "int32", 4, number_at<std::int32_t>},
                                 {"uint", "uint32", 4, number_at<std::uint32_t>},
                                 {"float", "float32", 4, number_at<float>},
                                 {"double", "float64", 8, number_at<double>}};

struct PlyProperty {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* count = nullptr;  ///< of a list
    bool corners = false;            ///< a face's
};

struct PlyElement {
    std::string name;
    long count = 0;
    std::vector<PlyProperty> properties;
};

constexpr std::size_t kMostElements = 20;
constexpr std::size_t kMostProperties = 100;

class PlyFile {
public:
    PlyFile(const std::string& name, const std::string& bytes)
        : bytes_(bytes), words_(bytes), mesh_(name, "PLY") {}

    Mesh read() {
        read_header();
        for (const PlyElement& element : elements_) {
            read_element(element);
        }
        return mesh_.take();
    }

private:
    [[noreturn]] void refuse(std::string_view word, const char* allowed) const {
        mesh_.fail(fmt::format("{}: must be {}", in_quotes(word), allowed));
    }
    const PlyType* type_of(std::string_view word) const {
        const auto* found = std::find_if(
            std::begin(kPlyTypes), std::end(kPlyTypes),
            [&](const PlyType& type) { return word == type.name || word == type.other_name; });
        if (found == std::end(kPlyTypes)) {
            refuse(word, "a type: char, uchar, short, ushort, int, uint, float or double");
        }
        return found;
    }

    void read_format() {
        const std::string_view word = words_.on_line();
        if (word == "ascii") {
            form_ = PlyForm::ascii;
        } else if (word == "binary_little_endian") {
            form_ = PlyForm::little;
        } else if (word == "binary_big_endian") {
            form_ = PlyForm::big;
        } else {
            refuse(word, "ascii, binary_little_endian or binary_big_endian");
        }
    }
    void read_element_line() {
        PlyElement element;
        element.name = words_.on_line();
        const std::string_view count = words_.on_line();
        element.count = integer_of(count).value_or(-1);
        if (element.count < 0) {
            refuse(count, "how many there are");
        }
        elements_.push_back(std::move(element));
        if (elements_.size() > kMostElements) {
            mesh_.fail(fmt::format("more than {} elements", kMostElements));
        }
    }
    void read_property_line() {
        if (elements_.empty()) {
            mesh_.fail("a property must stand after its element");
        }
        PlyProperty property;
        std::string_view word = words_.on_line();
        if (word == "list") {
            property.count = type_of(words_.on_line());
            word = words_.on_line();
        }
        property.type = type_of(word);
        property.name = words_.on_line();
        property.corners = property.count != nullptr && elements_.back().name == "face" &&
                           (property.name == "vertex_indices" || property.name == "vertex_index");
        elements_.back().properties.push_back(std::move(property));
        if (elements_.back().properties.size() > kMostProperties) {
            mesh_.fail(fmt::format("more than {} properties", kMostProperties));
        }
    }
    void read_header() {
        mesh_.at(1);
        if (!words_.next_line() || words_.on_line() != "ply") {
            mesh_.fail("no PLY: must begin with \"ply\"");
        }
        std::optional<PlyForm> form;
        while (true) {
            if (!words_.next_line()) {
                mesh_.fail("the file ends within its header, which ends with `end_header`");
            }
            mesh_.at(words_.line());
            const std::string_view word = words_.on_line();
            if (word == "end_header") {
                break;
            }
            if (word == "format") {
                read_format();
                form = form_;
            } else if (word == "element") {
                read_element_line();
            } else if (word == "property") {
                read_property_line();
            } else if (word != "comment" && word != "obj_info" && !word.empty()) {
                refuse(word, "format, element, property, comment, obj_info or end_header");
            }
        }
        if (!form) {
            mesh_.fail("the header has no format");
        }
        if (form_ != PlyForm::ascii) {
            mesh_.at(0);
            at_ = std::min(words_.end_of_line() + 1, bytes_.size());
        }
    }

    [[noreturn]] void fail_short(const PlyElement& element) const {
        mesh_.fail(fmt::format("cut short: it ends within its {} {} of \"{}\"", element.count,
                               element.count == 1 ? "piece" : "pieces", element.name));
    }
    double next(const PlyType& type, const PlyElement& element) {
        if (form_ == PlyForm::ascii) {
            const std::string_view word = words_.next();
            mesh_.at(words_.line());
            if (word.empty()) {
                fail_short(element);
            }
            const auto value = number_of(word);
            if (!value) {
                refuse(word, "a number");
            }
            return *value;
        }
        if (bytes_.size() - at_ < type.bytes) {
            fail_short(element);
        }
        char bytes[8] = {};
        std::memcpy(bytes, bytes_.data() + at_, type.bytes);
        at_ += type.bytes;
        if ((form_ == PlyForm::big) == (std::endian::native == std::endian::little)) {
            std::reverse(bytes, bytes + type.bytes);
        }
        return type.read(bytes);
    }
    long next_integer(const PlyType& type, const PlyElement& element) {
        const double value = next(type, element);
        if (!(std::abs(value) <= 2147483647.0) || value != std::floor(value)) {
            mesh_.fail(
                fmt::format("{:.6g} in \"{}\": must be a whole number", value, element.name));
        }
        return static_cast<long>(value);
    }

    void read_list(const PlyProperty& property, const PlyElement& element) {
        const long count = next_integer(*property.count, element);
        if (count < 0) {
            mesh_.fail(fmt::format("a list of {} in \"{}\"", count, element.name));
        }
        if (!property.corners) {
            skip(count, *property.type, element);
            return;
        }
        if (count > static_cast<long>(kMostPoints)) {
            mesh_.fail(
                fmt::format("a face of {} corners, must have at most {}", count, kMostPoints));
        }
        list_.clear();
        for (long i = 0; i < count; ++i) {
            list_.push_back(next_integer(*property.type, element));
        }
        mesh_.polygon(list_);
    }
    void skip(long count, const PlyType& type, const PlyElement& element) {
        if (form_ != PlyForm::ascii) {
            const auto bytes = static_cast<std::size_t>(count) * type.bytes;
            if (bytes_.size() - at_ < bytes) {
                fail_short(element);
            }
            at_ += bytes;
            return;
        }
        for (long i = 0; i < count; ++i) {  // ends where the file does
            (void)next(type, element);
        }
    }
    void read_element(const PlyElement& element) {
        if (element.properties.empty()) {
            return;
        }
        const bool points = element.name == "vertex";
        unsigned found = 0;
        for (long i = 0; i < element.count; ++i) {
            Vector3 point = Vector3::Zero();
            for (const PlyProperty& property : element.properties) {
                if (property.count != nullptr) {
                    read_list(property, element);
                    continue;
                }
                const double value = next(*property.type, element);
                const std::size_t axis =
                    property.name.size() == 1 ? std::string_view("xyz").find(property.name) : 3;
                if (axis < 3) {
                    point[static_cast<Eigen::Index>(axis)] = value;
                    found |= 1U << axis;
                }
            }
            if (points && found != 7) {
                mesh_.fail("a vertex must have x, y and z");
            }
            if (points) {
                mesh_.point(point);
            }
        }
    }

    const std::string& bytes_;
    Words words_;
    MeshBuilder mesh_;
    PlyForm form_ = PlyForm::ascii;
    std::vector<PlyElement> elements_;
    std::vector<long> list_;
    std::size_t at_ = 0;  ///< in a binary file
};

}  // namespace

Mesh read_ply(const std::filesystem::path& file) {
    const std::string bytes = read_file(file, {"mesh of a PLY", kMostMesh_MB});
    return PlyFile(file.string(), bytes).read();
}

}  // namespace limpet::meshes
