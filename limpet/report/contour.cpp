// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace limpet {
namespace {

/// An edge of the grid: from point `point`, to the right or up.
struct Edge {
    std::size_t point = 0;
    bool up = false;
    bool operator==(const Edge& other) const { return point == other.point && up == other.up; }
    bool operator<(const Edge& other) const {
        return point != other.point ? point < other.point : up < other.up;
    }
};

/// Crossings of the level, and which of them a cell joins: each has one or two neighbours.
class Crossings {
public:
    Crossings(const Grid& grid, double level) : grid_(grid), level_(level) {
        for (std::size_t j = 0; j + 1 < grid.y.size(); ++j) {
            for (std::size_t i = 0; i + 1 < grid.x.size(); ++i) {
                cell(i, j);
            }
        }
    }

    [[nodiscard]] std::vector<ContourLine> lines() {
        std::vector<ContourLine> found;
        // Open lines first, from their ends; what is left are rings.
        for (const bool ring : {false, true}) {
            for (auto& [edge, neighbours] : joined_) {
                if (!neighbours.empty() && (ring || neighbours.size() == 1)) {
                    found.push_back(follow(edge));
                }
            }
        }
        return found;
    }

private:
    void cell(std::size_t i, std::size_t j) {
        const std::array<double, 4> corners = {grid_.at(i, j), grid_.at(i + 1, j),
                                               grid_.at(i + 1, j + 1), grid_.at(i, j + 1)};
        if (!std::all_of(corners.begin(), corners.end(),
                         [](double z) { return std::isfinite(z); })) {
            return;
        }
        const std::size_t n = grid_.x.size(), point = j * n + i;
        // Around the cell: below, right, above, left; edge k lies between corners k and k + 1.
        const std::array<Edge, 4> edges = {Edge{point, false}, Edge{point + 1, true},
                                           Edge{point + n, false}, Edge{point, true}};
        std::array<Edge, 4> crossed;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            if ((corners[k] > level_) != (corners[(k + 1) % 4] > level_)) {
                crossed[count++] = edges[k];
            }
        }
        if (count == 2) {
            join(crossed[0], crossed[1]);
        } else if (count == 4) {
            const double mean = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
            // The corners that are unlike the middle are cut off, each by a line of its own.
            const bool cut_first = (corners[0] > level_) != (mean > level_);
            join(edges[0], edges[cut_first ? 3 : 1]);
            join(edges[2], edges[cut_first ? 1 : 3]);
        }
    }

    void join(const Edge& a, const Edge& b) {
        joined_[a].push_back(b);
        joined_[b].push_back(a);
    }

    [[nodiscard]] ContourPoint crossing(const Edge& edge) const {
        const std::size_t n = grid_.x.size();
        const std::size_t i = edge.point % n, j = edge.point / n;
        const std::size_t i1 = edge.up ? i : i + 1, j1 = edge.up ? j + 1 : j;
        const double a = grid_.at(i, j), b = grid_.at(i1, j1);
        const double share = (level_ - a) / (b - a);
        return {grid_.x[i] + share * (grid_.x[i1] - grid_.x[i]),
                grid_.y[j] + share * (grid_.y[j1] - grid_.y[j])};
    }

    /// Walks from crossing to crossing and takes away the joints behind it.
    ContourLine follow(Edge edge) {
        ContourLine line = {crossing(edge)};
        while (!joined_[edge].empty()) {
            const Edge next = joined_[edge].back();
            joined_[edge].pop_back();
            auto& back = joined_[next];
            back.erase(std::find(back.begin(), back.end(), edge));
            line.push_back(crossing(next));
            edge = next;
        }
        return line;
    }

    const Grid& grid_;
    double level_;
    std::map<Edge, std::vector<Edge>> joined_;
};

/// @return the cell that holds `value` and how far into it, or false
bool locate(const std::vector<double>& axis, double value, std::size_t& cell, double& share) {
    if (!(value >= axis.front() && value <= axis.back())) {
        return false;
    }
    const auto after = std::upper_bound(axis.begin(), axis.end(), value);
    const auto last = static_cast<std::ptrdiff_t>(axis.size()) - 2;
    cell = static_cast<std::size_t>(std::clamp(after - axis.begin() - 1, std::ptrdiff_t{0}, last));
    share = (value - axis[cell]) / (axis[cell + 1] - axis[cell]);
    return true;
}

}  // namespace

std::vector<ContourLine> contour(const Grid& grid, double level) {
    return Crossings(grid, level).lines();
}

double interpolated(const Grid& grid, double x, double y) {
    std::size_t i = 0, j = 0;
    double u = 0.0, v = 0.0;
    if (!locate(grid.x, x, i, u) || !locate(grid.y, y, j, v)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double low = grid.at(i, j) * (1.0 - u) + grid.at(i + 1, j) * u;
    const double high = grid.at(i, j + 1) * (1.0 - u) + grid.at(i + 1, j + 1) * u;
    return low * (1.0 - v) + high * v;
}

}  // namespace limpet
