// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>

#include "limpet/draw/gnuplot.hpp"
#include "limpet/lab/learn.hpp"
#include "limpet/lab/many.hpp"
#include "limpet/lab/swing.hpp"
#include "limpet/serve/server.hpp"

namespace limpet::lab {

/// Replies to the page. Nothing is kept between two requests but the flights that it began
/// and has not ended: a campaign, what turning each parameter does, the map of the swing.
class Lab {
public:
    /// @param scenario  that the page opens with
    /// @param stop      ends a flight and the answer to come; lives as long
    /// @param keep      folder in which results of campaigns stay; empty: nothing stays
    /// @throws InputError if there is no such scenario, or the program has no page
    explicit Lab(std::string scenario, const std::atomic<bool>* stop = nullptr,
                 std::filesystem::path keep = {});
    ~Lab() = default;
    Lab(const Lab&) = delete;
    Lab& operator=(const Lab&) = delete;

    /// {"scenario": the first, "scenarios": [{"name", "description"}], "surfaces", "vehicles",
    ///  "campaigns"}
    [[nodiscard]] std::string catalogue() const;
    /// Every number that can be set, as the scenario ships it.
    /// @param request  {"scenario": "perch_concrete", "set": ["wall.surface=metal", ...]}
    /// @return {"sections": [{"name", "rows": [{"key", "unit", "minimum", "maximum", "value",
    ///         "kind", "what", "source"}], "choices": [{"key", "names", "chosen"}]}]}
    /// @throws InputError one line, as do those below
    [[nodiscard]] std::string schema(std::string_view request) const;
    /// @param request  as above; with "brief": true what a picture needs, at 25 Hz, for a slider
    ///                 that is moving; with "topics" their messages alone
    /// @return an MCAP recording
    [[nodiscard]] std::string fly(std::string_view request);
    /// @return the scenario as YAML that stands for itself
    [[nodiscard]] std::string yaml(std::string_view request) const;

    /// The page and the replies to its requests; `server` must end before this does.
    void serve_on(serve::Server& server);

private:
    std::string first_;
    const std::atomic<bool>* stop_;
    const draw::gnuplot::TemporaryFolder scratch_;
    Learn learn_;
    Swing swing_;
    Many many_;
};

}  // namespace limpet::lab
