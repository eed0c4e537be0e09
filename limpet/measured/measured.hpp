// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What others measured on hardware that is not the paper's, held against the models of the
/// product. Nothing is turned for a row but the one number that it names as fitted.
namespace limpet::measured {

/// By name: "tilt_deg", "pump_ultimate_Pa".
using Numbers = std::map<std::string, double>;

/// A number that a law looks at, and where it has a meaning.
struct Quantity {
    std::string_view name;
    double from = 0.0, to = 1e9;
    bool whole = false;
};

/// A model's answer to a measurement.
struct Law {
    std::string_view name;
    std::vector<Quantity> needs;   ///< that a series must have
    std::vector<Quantity> allows;  ///< and may have
    /// What it says where there is nothing to say: a gain of 1, no force.
    std::optional<double> without = {};
    /// The number that is fitted where it is not given; empty: the law has none.
    std::string_view fits = {};
    double fits_from = 0.0, fits_to = 0.0;  ///< > 0, where it is looked for
    /// @param numbers  with the fitted one
    /// @param x        rising
    /// @return as many
    std::vector<double> (*say)(const Numbers& numbers, std::span<const double> x) = nullptr;
};
/// All, by name.
[[nodiscard]] std::span<const Law> laws();

/// Points of one run of an experiment.
struct Series {
    Numbers numbers = {};
    std::vector<double> x = {};
    std::vector<double> y = {};
};

/// One row of the table.
struct Measurement {
    std::string id = {};
    std::string group = {};   ///< the file's name: "ground"
    std::string what = {};    ///< was measured
    std::string source = {};  ///< by whom, where it stands, and its licence
    std::string x = {};       ///< "z/R [-]"
    std::string unit = {};    ///< of y
    const Law* law = nullptr;
    std::vector<Series> series = {};
    /// The measurement's own, of one point in the unit, as a standard deviation: what the same
    /// measurement gives when it is repeated. None: the source gives none.
    std::optional<double> scatter = {};
    std::string scatter_of = {};  ///< what it was taken from, or why there is none
    std::string note = {};        ///< what differs and why; may be empty
};

/// What was found and could not be used.
struct LookedAt {
    std::string what = {};
    std::string where = {};
    std::string why = {};
};

struct Measurements {
    std::vector<Measurement> rows = {};
    std::vector<LookedAt> looked_at = {};
};

/// Every file of a folder like data/others, by name; the head of ground.yaml describes the keys.
/// @throws InputError for what is not so: no file there, an unknown key or law, a number that the
/// law has no use for, lacks or has no answer at, x that does not rise from 0 or above, lists of
/// different lengths
[[nodiscard]] Measurements load_measurements(const std::filesystem::path& folder);
/// Of the data.
[[nodiscard]] std::filesystem::path others_folder();

enum class Verdict {
    holds,    ///< scatter makes errors so large, or larger ones, in one case of kRare or more
    differs,  ///< it does not: the measurement shows that the law is not all
    open,     ///< no scatter is known, or one so large that Law::without would hold as well
};

/// Below this probability a row differs.
inline constexpr double kRare = 0.01;

/// A measurement, and what its law says of it.
struct Comparison {
    std::vector<std::vector<double>> said = {};  ///< of each series, at its x
    std::optional<double> fitted = {};
    double rms = 0.0;      ///< of said less measured, over all points
    double largest = 0.0;  ///< of their magnitudes
    /// That scatter alone makes the sum of squares so large (chi-squared, points less what was
    /// fitted); points count as independent. None without a scatter.
    std::optional<double> p = {};
    Verdict verdict = Verdict::open;
};
/// A number is fitted to all series together, by least squares.
[[nodiscard]] Comparison compare(const Measurement& measurement);

}  // namespace limpet::measured
