// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "limpet/core/allowance.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/ulog/ulog.hpp"

namespace limpet::ulog {
namespace {

using namespace record;  // of whose columns a log is made

constexpr std::size_t kHeaderBytes = 16;
constexpr std::size_t kMostElements = 10'000;  ///< of a message, all arrays and parts spelled out
constexpr std::size_t kStampBytes = 8;

/// A number in a message: how it is read and where it goes.
struct Element {
    std::string name;
    std::size_t offset = 0;
    std::size_t bytes = 0;
    double (*read)(const char* bytes) = nullptr;
};

/// The numbers behind the time stamp, which every message begins with.
using Layout = std::vector<Element>;

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

/// Lays a message out by its definition and those of its parts. What it goes through and what it
/// makes is taken from the allowance; a definition that makes no sense throws InputError.
class LayoutMaker {
public:
    LayoutMaker(const Formats& formats, Allowance& allowance)
        : formats_(formats), allowance_(allowance) {}

    [[nodiscard]] Layout of(std::string_view type) {
        add(type, "", 0);
        if (!stamped_) {
            throw InputError("it does not begin with uint64_t timestamp");
        }
        return std::move(layout_);
    }

private:
    struct FieldType {
        std::string_view name;
        std::size_t count = 1;
        bool array = false;
    };

    void add(std::string_view type, const std::string& prefix, int depth) {
        const auto found = formats_.find(type);
        if (found == formats_.end()) {
            throw InputError(fmt::format("there is no format {}", in_quotes(type)));
        }
        if (depth > kMostLevels) {
            throw InputError(fmt::format("more than {} messages within each other", kMostLevels));
        }
        allowance_.take_definition(found->second.size());
        std::string_view fields = found->second;
        while (!fields.empty()) {
            const std::size_t end = std::min(fields.find(';'), fields.size());
            if (end > 0) {
                add_field(fields.substr(0, end), prefix, depth);
            }
            fields.remove_prefix(std::min(end + 1, fields.size()));
        }
    }

    /// "float[3]"
    static FieldType field_type(std::string_view text) {
        FieldType type{.name = text.substr(0, text.find('['))};
        type.array = type.name.size() < text.size();
        if (type.array) {
            const char* const digits = text.data() + type.name.size() + 1;
            const char* const end = text.data() + text.size();
            const auto [rest, error] = std::from_chars(digits, end, type.count);
            if (error != std::errc{} || rest + 1 != end || *rest != ']' ||
                type.count > kMostElements) {
                throw InputError(fmt::format("{} is no type, an array has 0..{} elements",
                                             in_quotes(text), kMostElements));
            }
        }
        return type;
    }

    /// "float[3] xyz"
    void add_field(std::string_view field, const std::string& prefix, int depth) {
        const std::size_t blank = field.find(' ');
        if (blank == std::string_view::npos) {
            throw InputError(fmt::format("field {} has no name", in_quotes(field)));
        }
        const std::string_view own_name = field.substr(blank + 1);
        if (own_name.empty() || own_name.size() > kLongestFieldName) {
            throw InputError(fmt::format("a field's name of {} characters, allowed 1..{}",
                                         own_name.size(), kLongestFieldName));
        }
        const FieldType type = field_type(field.substr(0, blank));
        const std::string name = prefix + std::string(own_name);
        const auto* const plain =
            std::find_if(std::begin(kPlain), std::end(kPlain),
                         [&](const Plain& one) { return one.type == type.name; });
        if (plain == std::end(kPlain)) {
            add_parts(type, name, depth);
        } else if (plain->read == nullptr || own_name.starts_with("_padding")) {
            look_at_one();
            bytes_ += type.count * plain->bytes;
        } else {
            add_numbers(*plain, type, name);
        }
    }

    void add_parts(const FieldType& type, const std::string& name, int depth) {
        for (std::size_t i = 0; i < type.count; ++i) {
            look_at_one();
            add(type.name, (type.array ? fmt::format("{}[{}]", name, i) : name) + ".", depth + 1);
        }
    }

    void add_numbers(const Plain& plain, const FieldType& type, const std::string& name) {
        for (std::size_t i = 0; i < type.count; ++i) {
            look_at_one();
            if (bytes_ == 0) {
                stamped_ = name == "timestamp" && plain.type == "uint64_t";
            } else {
                Element element{type.array ? fmt::format("{}[{}]", name, i) : name, bytes_,
                                plain.bytes, plain.read};
                allowance_.take_bytes(sizeof element + element.name.size());
                layout_.push_back(std::move(element));
            }
            bytes_ += plain.bytes;
        }
    }

    void look_at_one() {
        if (++looked_at_ > kMostElements) {
            throw InputError(fmt::format("more than {} fields", kMostElements));
        }
        allowance_.take_fields(1);
    }

    const Formats& formats_;
    Allowance& allowance_;
    Layout layout_;
    std::size_t bytes_ = 0;
    std::size_t looked_at_ = 0;  ///< texts, padding and empty parts among them
    bool stamped_ = false;
};

/// A topic that is logged under a number.
struct Logged {
    std::shared_ptr<const Layout> layout;
    std::size_t table = 0;
};

class UlogFile {
public:
    UlogFile(const std::filesystem::path& path, const std::string& bytes)
        : path_(path), bytes_(bytes), allowance_(allowed_bytes(bytes.size())) {
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
            try {
                message(bytes_[at + 2], content);
            } catch (const TooMuch& problem) {
                refuse(problem.what());
            }
            at += kHead + content.size();
        }
        std::erase_if(recording_.tables, [](const Table& table) { return table.time_s.empty(); });
        return std::move(recording_);
    }

private:
    /// A log is not packed: as doubles it takes eight times its size, if it is bytes alone.
    [[nodiscard]] static std::uint64_t allowed_bytes(std::uint64_t file_bytes) {
        constexpr std::uint64_t kAnyFile_bytes = 32'000'000;
        constexpr std::uint64_t kMost_bytes = 2'000'000'000;
        constexpr std::uint64_t kTimes = 20;
        return std::min(kAnyFile_bytes + kTimes * file_bytes, kMost_bytes);
    }

    [[nodiscard]] std::size_t size_at(std::size_t at) const {
        return static_cast<std::size_t>(read_as<std::uint16_t>(bytes_.data() + at));
    }

    void message(char type, std::string_view content) {
        if (type == 'F') {
            format(content);
        } else if (type == 'A' && content.size() > 3) {
            subscribe(static_cast<std::uint8_t>(content[0]),
                      static_cast<int>(read_as<std::uint16_t>(content.data() + 1)),
                      content.substr(3));
        } else if (type == 'D' && content.size() > 2) {
            data(static_cast<int>(read_as<std::uint16_t>(content.data())), content.substr(2));
        } else if (type == 'P' && !content.empty()) {
            parameter(content);
        }
    }

    /// Length of the key, "float THR_MDL_FAC", its value. What is no number is passed over.
    void parameter(std::string_view content) {
        const auto length = static_cast<std::size_t>(static_cast<std::uint8_t>(content[0]));
        constexpr std::size_t kValueBytes = 4;
        if (content.size() != 1 + length + kValueBytes) {
            return;
        }
        const std::string_view key = content.substr(1, length);
        const char* const value = content.data() + 1 + length;
        const std::size_t blank = std::min(key.find(' '), key.size() - 1);
        const std::string_view type = key.substr(0, blank);
        if (type == "float" || type == "int32_t") {
            allowance_.take_bytes(kNode_bytes);
            recording_.metadata[std::string(kPx4Parameters)][std::string(key.substr(blank + 1))] =
                fmt::format("{}",
                            type == "float" ? read_as<float>(value) : read_as<std::int32_t>(value));
        }
    }

    void format(std::string_view content) {
        const std::size_t colon = content.find(':');
        if (colon == std::string_view::npos) {
            refuse("a format without a name");
        }
        const std::string_view name = content.substr(0, colon);
        const std::string_view fields = content.substr(colon + 1);
        const auto found = formats_.find(name);
        if (found == formats_.end()) {
            allowance_.take_bytes(kNode_bytes + content.size());
            formats_.emplace(name, fields);
        } else if (found->second != fields) {
            refuse(fmt::format("two formats of {} that are not alike", in_quotes(name)));
        }
    }

    /// One a type: thousands of numbers may be subscribed to one topic.
    std::shared_ptr<const Layout> layout_of(std::string_view type) {
        const auto known = layouts_.find(type);
        if (known != layouts_.end()) {
            return known->second;
        }
        try {
            auto made = std::make_shared<const Layout>(LayoutMaker(formats_, allowance_).of(type));
            layouts_.emplace(type, made);
            return made;
        } catch (const TooMuch&) {
            throw;
        } catch (const InputError& problem) {
            refuse(fmt::format("the format of {} cannot be read: {}", in_quotes(type),
                               problem.what()));
        }
    }

    /// A topic that is subscribed again goes on where it was.
    void subscribe(int instance, int id, std::string_view name) {
        if (name.size() > kLongestFieldName) {
            refuse(fmt::format("a topic's name of {} characters, allowed 1..{}", name.size(),
                               kLongestFieldName));
        }
        Logged logged{.layout = layout_of(name), .table = recording_.tables.size()};
        Table table;
        table.topic = instance == 0 ? std::string(name) : fmt::format("{}.{}", name, instance);
        table.type = name;
        const auto [at, is_new] = tables_.try_emplace(table.topic, logged.table);
        logged.table = at->second;
        if (is_new) {
            allowance_.take_fields(1 + logged.layout->size());
            allowance_.take_bytes(kNode_bytes + sizeof(Table) + 3 * table.topic.size());
            for (const Element& element : *logged.layout) {
                allowance_.take_bytes(sizeof(Column) + element.name.size());
                table.columns.push_back({element.name, {}});
            }
            recording_.tables.push_back(std::move(table));
        }
        logged_[id] = std::move(logged);
    }

    void data(int id, std::string_view content) {
        const auto found = logged_.find(id);
        if (found == logged_.end() || content.size() < kStampBytes) {
            return;
        }
        constexpr double kMicro = 1e-6;
        Table& table = recording_.tables[found->second.table];
        allowance_.take_bytes(sizeof(double) * (1 + table.columns.size()));
        table.time_s.push_back(kMicro * read_as<std::uint64_t>(content.data()));
        std::size_t c = 0;
        for (const Element& element : *found->second.layout) {
            // What is cut off at the end is padding, or a logger's mistake.
            const bool whole = element.offset + element.bytes <= content.size();
            table.columns[c++].values.push_back(
                whole ? element.read(content.data() + element.offset) : kNaN);
        }
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(fmt::format("{}: {}", path_.string(), why));
    }

    static constexpr std::size_t kNode_bytes = 128;  ///< of a map, around what is kept in it

    const std::filesystem::path& path_;
    const std::string& bytes_;
    Allowance allowance_;
    Recording recording_;
    Formats formats_;
    std::map<std::string, std::shared_ptr<const Layout>, std::less<>> layouts_;
    std::map<std::string, std::size_t, std::less<>> tables_;  ///< by topic
    std::map<int, Logged> logged_;
};

}  // namespace

Recording read_ulog(const std::filesystem::path& path) {
    const std::string bytes = read_file(path, {"PX4 log", 1000});
    return UlogFile(path, bytes).read();
}

}  // namespace limpet::ulog
