// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/ulog_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"

namespace limpet::record {
namespace {

constexpr std::size_t kHeaderBytes = 16;
constexpr std::size_t kMostElements = 10'000;  ///< of a message, all arrays and parts spelled out
constexpr int kDeepest = 8;                    ///< messages within messages

/// A number in a message: how it is read and where it goes.
struct Element {
    std::string name;
    std::size_t offset = 0;
    double (*read)(const char* bytes) = nullptr;  ///< null: a text or padding
};

struct Layout {
    std::vector<Element> elements;
    std::size_t bytes = 0;
};

template <class T>
double read_as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

struct Plain {
    std::string_view type;
    std::size_t bytes;
    double (*read)(const char*);
};
constexpr Plain kPlain[] = {
    {"int8_t", 1, read_as<std::int8_t>},   {"uint8_t", 1, read_as<std::uint8_t>},
    {"int16_t", 2, read_as<std::int16_t>}, {"uint16_t", 2, read_as<std::uint16_t>},
    {"int32_t", 4, read_as<std::int32_t>}, {"uint32_t", 4, read_as<std::uint32_t>},
    {"int64_t", 8, read_as<std::int64_t>}, {"uint64_t", 8, read_as<std::uint64_t>},
    {"float", 4, read_as<float>},          {"double", 8, read_as<double>},
    {"bool", 1, read_as<std::uint8_t>},    {"char", 1, nullptr},
};

using Formats = std::map<std::string, std::string, std::less<>>;

/// Lays a message out by its definition and those of its parts.
class LayoutMaker {
public:
    explicit LayoutMaker(const Formats& formats) : formats_(formats) {}

    [[nodiscard]] std::optional<Layout> of(std::string_view type) {
        layout_ = {};
        visited_ = 0;
        return add(type, "", 0) ? std::optional(layout_) : std::nullopt;
    }

private:
    /// @return false where a definition is missing or makes no sense
    bool add(std::string_view type, const std::string& prefix, int depth) {
        const auto found = formats_.find(type);
        if (found == formats_.end() || depth > kDeepest) {
            return false;
        }
        std::string_view fields = found->second;
        while (!fields.empty()) {
            const std::size_t end = std::min(fields.find(';'), fields.size());
            if (end > 0 && !add_field(fields.substr(0, end), prefix, depth)) {
                return false;
            }
            fields.remove_prefix(std::min(end + 1, fields.size()));
        }
        return true;
    }

    /// "float[3] xyz"
    bool add_field(std::string_view field, const std::string& prefix, int depth) {
        const std::size_t blank = field.find(' ');
        if (blank == std::string_view::npos) {
            return false;
        }
        std::string_view type = field.substr(0, blank);
        const std::string name = prefix + std::string(field.substr(blank + 1));
        std::size_t count = 1;
        const std::size_t bracket = type.find('[');
        const bool array = bracket != std::string_view::npos;
        if (array) {
            const char* const digits = type.data() + bracket + 1;
            const auto [rest, error] = std::from_chars(digits, type.data() + type.size(), count);
            if (error != std::errc{} || rest == digits || count > kMostElements) {
                return false;
            }
            type = type.substr(0, bracket);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::string element = array ? fmt::format("{}[{}]", name, i) : name;
            if (++visited_ > kMostElements || !add_element(type, element, depth)) {
                return false;
            }
        }
        return true;
    }

    bool add_element(std::string_view type, const std::string& name, int depth) {
        for (const Plain& plain : kPlain) {
            if (plain.type == type) {
                if (name.find("_padding") == std::string::npos) {
                    layout_.elements.push_back({name, layout_.bytes, plain.read});
                }
                layout_.bytes += plain.bytes;
                return true;
            }
        }
        return add(type, name + ".", depth + 1);
    }

    const Formats& formats_;
    Layout layout_;
    std::size_t visited_ = 0;  ///< elements, texts, padding and empty parts among them
};

/// A topic that is logged under a number.
struct Logged {
    Layout layout;
    std::size_t table = 0;
    std::vector<std::size_t> elements;  ///< of the columns, in their order
};

class UlogFile {
public:
    UlogFile(const std::filesystem::path& path, const std::string& bytes)
        : path_(path), bytes_(bytes) {
        recording_.path = path;
    }

    Recording read() {
        constexpr std::string_view kMagic = "ULog\x01\x12\x35";
        if (!std::string_view(bytes_).starts_with(kMagic)) {
            throw InputError(path_.string() + ": is no log of PX4's: it does not begin with ULog");
        }
        if (bytes_.size() < kHeaderBytes) {
            throw InputError(path_.string() + ": is a log of PX4's that ends in its head");
        }
        std::size_t at = kHeaderBytes;
        while (at < bytes_.size()) {
            constexpr std::size_t kHead = 3;
            if (at + kHead > bytes_.size() || at + kHead + size_at(at) > bytes_.size()) {
                recording_.damage = "it ends in the middle of a message";
                break;
            }
            const std::string_view content(bytes_.data() + at + kHead, size_at(at));
            message(bytes_[at + 2], content);
            at += kHead + content.size();
        }
        std::erase_if(recording_.tables, [](const Table& table) { return table.time_s.empty(); });
        return std::move(recording_);
    }

private:
    [[nodiscard]] std::size_t size_at(std::size_t at) const {
        return static_cast<std::size_t>(read_as<std::uint16_t>(bytes_.data() + at));
    }

    void message(char type, std::string_view content) {
        if (type == 'F') {
            const std::size_t colon = content.find(':');
            if (colon == std::string_view::npos) {
                refuse("a format without a name");
            }
            formats_[std::string(content.substr(0, colon))] = content.substr(colon + 1);
        } else if (type == 'A' && content.size() > 3) {
            subscribe(static_cast<std::uint8_t>(content[0]),
                      static_cast<int>(read_as<std::uint16_t>(content.data() + 1)),
                      content.substr(3));
        } else if (type == 'D' && content.size() > 2) {
            data(static_cast<int>(read_as<std::uint16_t>(content.data())), content.substr(2));
        }
    }

    void subscribe(int instance, int id, std::string_view name) {
        const std::optional<Layout> layout = LayoutMaker(formats_).of(name);
        if (!layout || layout->elements.empty() || layout->elements[0].name != "timestamp") {
            refuse(fmt::format("the format of {} cannot be read", name));
        }
        Logged logged{.layout = *layout, .table = recording_.tables.size(), .elements = {}};
        Table table;
        table.topic = instance == 0 ? std::string(name) : fmt::format("{}.{}", name, instance);
        table.type = name;
        for (std::size_t i = 1; i < layout->elements.size(); ++i) {
            if (layout->elements[i].read != nullptr) {
                table.columns.push_back({layout->elements[i].name, {}});
                logged.elements.push_back(i);
            }
        }
        allowance_.take_fields(table.columns.size());
        recording_.tables.push_back(std::move(table));
        logged_[id] = std::move(logged);
    }

    void data(int id, std::string_view content) {
        const auto found = logged_.find(id);
        if (found == logged_.end()) {
            return;
        }
        const Logged& logged = found->second;
        constexpr double kMicro = 1e-6;
        constexpr std::size_t kStamp = 8;
        if (content.size() < kStamp) {
            return;
        }
        Table& table = recording_.tables[logged.table];
        allowance_.take_bytes(sizeof(double) * (1 + table.columns.size()));
        table.time_s.push_back(kMicro * read_as<std::uint64_t>(content.data()));
        for (std::size_t c = 0; c < logged.elements.size(); ++c) {
            const Element& element = logged.layout.elements[logged.elements[c]];
            // What is cut off at the end is padding, or a logger's mistake.
            constexpr std::size_t kWidest = 8;
            char wide[kWidest] = {};
            if (element.offset < content.size()) {
                std::memcpy(wide, content.data() + element.offset,
                            std::min(kWidest, content.size() - element.offset));
            }
            table.columns[c].values.push_back(element.read(wide));
        }
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(fmt::format("{}: {}", path_.string(), why));
    }

    const std::filesystem::path& path_;
    const std::string& bytes_;
    Recording recording_;
    Formats formats_;
    std::map<int, Logged> logged_;
    TableAllowance allowance_{1'000'000'000};
};

}  // namespace

Recording read_ulog(const std::filesystem::path& path) {
    const std::string bytes = read_file(path, {"PX4 log", 1000});
    return UlogFile(path, bytes).read();
}

}  // namespace limpet::record
