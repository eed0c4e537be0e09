// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::mavlink {
namespace {

constexpr std::array<Verdict, 5> kRefused = {Verdict::not_signed, Verdict::wrong_signature,
                                             Verdict::replayed, Verdict::too_old,
                                             Verdict::too_many_senders};

struct Words {
    std::string_view what;
    std::string_view cause;  ///< what it takes to be so with a peer that is none of bad will
};

Words words(Verdict verdict) {
    switch (verdict) {
        case Verdict::accepted: break;
        case Verdict::not_signed: return {"not signed", ""};
        case Verdict::wrong_signature: return {"signed with another key", ""};
        case Verdict::replayed: return {"played again", ", or its clock was set back"};
        case Verdict::too_old: return {"over a minute too old", ": its clock is behind our time"};
        case Verdict::too_many_senders: return {"of one sender too many", ""};
    }
    throw InternalError("verdict out of range");
}

std::uint64_t of(const Refusals& refusals, Verdict verdict) {
    return refusals.by_verdict[static_cast<std::size_t>(verdict)];
}

std::uint64_t seconds(std::uint64_t signing_time) {
    return signing_time / kSigningSecond;
}

}  // namespace

std::uint64_t Refusals::total() const {
    return std::accumulate(by_verdict.begin(), by_verdict.end(), version_1);
}

void Refusals::count(Verdict verdict, const Frame& frame, std::uint64_t time, std::uint64_t now) {
    if (verdict == Verdict::accepted) {
        const std::uint64_t stamp = stamp_of(frame);
        most_ahead = std::max(most_ahead, stamp - std::min(stamp, now));
        return;
    }
    ++by_verdict[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::too_old) {
        most_behind = std::max(most_behind, time - stamp_of(frame));
    }
}

std::string reasons_of(const Refusals& refusals) {
    std::string text;
    for (const Verdict verdict : kRefused) {
        if (of(refusals, verdict) > 0) {
            const auto [what, cause] = words(verdict);
            text += fmt::format("{}{}{}", text.empty() ? "" : "; ", what, cause);
        }
    }
    if (refusals.version_1 > 0) {
        text += fmt::format("{}{}", text.empty() ? "" : "; ", kVersion1);
    }
    return text;
}

std::string text_of(const Refusals& refusals) {
    std::vector<std::string> parts;
    for (const Verdict verdict : kRefused) {
        if (of(refusals, verdict) > 0) {
            parts.push_back(fmt::format("{} {}", of(refusals, verdict), words(verdict).what));
        }
    }
    if (refusals.version_1 > 0) {
        parts.push_back(fmt::format("{} in MAVLink 1", refusals.version_1));
    }
    if (refusals.most_behind > 0) {
        parts.push_back(fmt::format("up to {} s behind our time", seconds(refusals.most_behind)));
    }
    std::string text = parts.empty() ? ""
                                     : fmt::format("{} frames refused: {}", refusals.total(),
                                                   fmt::join(parts, ", "));
    if (refusals.most_ahead > Signing::kLargestAge) {
        text += fmt::format("{}a peer's clock is {} s ahead of ours", text.empty() ? "" : "; ",
                            seconds(refusals.most_ahead));
    }
    return text;
}

}  // namespace limpet::mavlink
