// SPDX-License-Identifier: Apache-2.0
#include "limpet/ulog/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>

#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::ulog {
namespace {

using namespace record;  // of whose columns a log is made

constexpr std::size_t kMostElements = 10'000;  ///< of a message, all arrays and parts spelled out
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

}  // namespace

Layout layout_of_format(const Formats& formats, std::string_view type, Allowance& allowance) {
    return LayoutMaker(formats, allowance).of(type);
}

}  // namespace limpet::ulog
