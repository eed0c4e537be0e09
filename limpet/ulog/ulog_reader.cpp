// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "limpet/core/allowance.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/ulog/layout.hpp"
#include "limpet/ulog/ulog.hpp"

namespace limpet::ulog {
namespace {

using namespace record;  // of whose columns a log is made

constexpr std::size_t kHeaderBytes = 16;
constexpr std::size_t kStampBytes = 8;
constexpr std::size_t kHead = 3;  ///< of a message: its size, its type
/// A message that a logger writes now and then, to be found behind a damage.
constexpr std::string_view kSync("\x08\0S\x2F\x73\x13\x20\x25\x0C\xBB\x12", 11);

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
            const std::size_t end = part_end(at);
            if (at + kHead > end || at + kHead + size_at(at) > end) {
                if (end < bytes_.size()) {
                    at = end;  // what was appended stands behind what was cut short
                    continue;
                }
                damaged("it ends in the middle of a message");
                break;
            }
            const char type = bytes_[at + 2];
            if (type < 'A' || type > 'Z') {
                damaged(fmt::format("no message begins at byte {}", at));
                at = bytes_.find(kSync, at);
                continue;
            }
            const std::string_view content(bytes_.data() + at + kHead, size_at(at));
            try {
                message(type, content);
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

    /// Where the messages end that the one at this byte belongs to: at the file's end, or where
    /// more was appended to a log that was cut short.
    [[nodiscard]] std::size_t part_end(std::size_t at) const {
        std::size_t end = bytes_.size();
        for (const std::uint64_t offset : appended_) {
            if (offset > at && offset < end) {
                end = static_cast<std::size_t>(offset);
            }
        }
        return end;
    }
    void damaged(const std::string& how) {
        if (recording_.damage.empty()) {
            recording_.damage = how;
        }
    }

    /// Eight bits of what may be passed over, eight of what may not, three places.
    void flags(std::string_view content) {
        constexpr std::size_t kBits = 8;
        constexpr char kAppended = 1;
        if (content.size() < 2 * kBits + appended_.size() * sizeof(std::uint64_t)) {
            return;
        }
        const std::string_view needed = content.substr(kBits, kBits);
        if ((needed[0] & ~kAppended) != 0 || needed.find_first_not_of('\0', 1) != needed.npos) {
            refuse("is a log of a newer kind than 1, which this reader does not know");
        }
        if ((needed[0] & kAppended) != 0) {
            std::memcpy(appended_.data(), content.data() + 2 * kBits, sizeof appended_);
        }
    }

    void message(char type, std::string_view content) {
        if (type == 'B') {
            flags(content);
        } else if (type == 'F') {
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
            auto made =
                std::make_shared<const Layout>(layout_of_format(formats_, type, allowance_));
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
        if (found == logged_.end()) {
            damaged(fmt::format("messages under number {}, which stands for no topic", id));
        }
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
    std::array<std::uint64_t, 3> appended_ = {};  ///< places in the file, 0: none
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
