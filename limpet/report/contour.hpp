// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace limpet {

/// Values over a grid: value of (x[i], y[j]) at j * x.size() + i.
struct Grid {
    const std::vector<double>& x;
    const std::vector<double>& y;
    const std::vector<double>& z;
    [[nodiscard]] double at(std::size_t i, std::size_t j) const { return z[j * x.size() + i]; }
};

struct ContourPoint {
    double x = 0.0;
    double y = 0.0;
};
/// A connected stretch; its last point is its first where it is closed.
using ContourLine = std::vector<ContourPoint>;

/// Where a value is `level`: marching squares, linear along the edges of the grid. A saddle is
/// parted by the mean of its corners. No line runs through a cell with a corner that is no number.
[[nodiscard]] std::vector<ContourLine> contour(const Grid& grid, double level);

/// The value between four points of the grid, bilinear; NaN next to what is no number and outside.
[[nodiscard]] double interpolated(const Grid& grid, double x, double y);

}  // namespace limpet
