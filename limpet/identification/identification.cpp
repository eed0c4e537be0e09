// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/identification/stages.hpp"
#include "limpet/identification/suspicion.hpp"
#include "limpet/identification/time_shift.hpp"

namespace limpet::identification {
namespace {

using P = CurveParameter;

constexpr std::size_t kFewestSamples = 20;
constexpr std::size_t kFewestOfAStage = 8;
constexpr std::size_t kFewestOfBaseline = 3;
constexpr double kPriceOfAKink = 25.0;  ///< in variances: the best of many chances gains some ten
constexpr double kRippleStandsOut = 15.0;  ///< exp(-15) of white noise's frequencies do

std::size_t sample_at(const PressureTrace& trace, double t_s) {
    return static_cast<std::size_t>(std::lower_bound(trace.t_s.begin(), trace.t_s.end(), t_s) -
                                    trace.t_s.begin());
}

/// A curve to begin with.
struct Guess {
    PressureCurve curve;
    std::vector<CurveParameter> free;
    double squares_Pa2 = 0.0;  ///< that it leaves, on a thinned copy
};

double time_of_63(const PressureTrace& trace, std::size_t from, double from_Pa, double to_Pa) {
    std::size_t i = from;
    const double level_Pa = from_Pa + 0.632 * (to_Pa - from_Pa);
    while (i + 1 < trace.t_s.size() &&
           (to_Pa > from_Pa ? trace.pressure_Pa[i] < level_Pa : trace.pressure_Pa[i] > level_Pa)) {
        ++i;
    }
    const double elapsed_s = std::max(trace.t_s[i] - trace.t_s[from], 1e-3);
    const double share = (trace.pressure_Pa[i] - from_Pa) / (to_Pa - from_Pa);
    return share >= 0.632 ? elapsed_s : elapsed_s / -std::log1p(-std::clamp(share, 0.01, 0.632));
}

void guess_sealing(const PressureTrace& trace, const Stages& stages,
                   const IdentificationOptions& options, std::size_t on, Guess& guess) {
    PressureCurve& curve = guess.curve;
    guess.free.push_back(P::tau_1);
    curve.baseline = on >= kFewestOfBaseline;
    curve.on_s = options.pump_on_s.value_or(trace.t_s[on]);
    curve.tau_1_s = time_of_63(trace, on, trace.pressure_Pa[on], stages.low_Pa);
    if (curve.baseline) {
        guess.free.push_back(P::atmosphere);
        curve.atmosphere_Pa = std::max(trace.pressure_Pa[on / 2], stages.low_Pa + 1.0);
        if (!options.pump_on_s) {
            guess.free.push_back(P::on);
        }
    } else {
        guess.free.push_back(P::start);
        curve.start_Pa = trace.pressure_Pa[on];
    }
}

/// @param see_atmosphere  whether the end of the log shows what it rises to
Guess guess_of(const PressureTrace& trace, const Stages& stages,
               const IdentificationOptions& options, std::size_t on, std::size_t off,
               bool see_atmosphere) {
    Guess guess{.curve = {.atmosphere_Pa = options.atmosphere_Pa,
                          .vacuum_Pa = stages.low_Pa,
                          .sealing = stages.sealing,
                          .unsealing = stages.unsealing,
                          .baseline = false},
                .free = {P::vacuum}};
    PressureCurve& curve = guess.curve;
    if (stages.sealing) {
        guess_sealing(trace, stages, options, on, guess);
    } else {
        curve.on_s = trace.t_s.front();
    }
    if (stages.unsealing) {
        curve.off_s = options.pump_off_s.value_or(trace.t_s[off]);
        guess.free.push_back(P::tau_2);
        if (!options.pump_off_s && (stages.sealing || off >= kFewestOfBaseline)) {
            guess.free.push_back(P::off);
        }
        if (see_atmosphere && !curve.baseline) {
            guess.free.push_back(P::atmosphere);
            curve.atmosphere_Pa = std::max(curve.atmosphere_Pa, stages.high_Pa + 1.0);
        }
        curve.tau_2_s = time_of_63(trace, off, trace.pressure_Pa[off], curve.atmosphere_Pa);
    } else {
        curve.off_s = std::numeric_limits<double>::infinity();
    }
    return guess;
}

/// Whether a kink that was fitted lies in the log's first samples: then there is none, the log
/// begins after it.
bool begins_later(const Guess& guess, const PressureTrace& trace) {
    const auto is_free = [&](P parameter) {
        return std::find(guess.free.begin(), guess.free.end(), parameter) != guess.free.end();
    };
    const double first_s = trace.t_s[kFewestOfBaseline];
    return (is_free(P::on) && guess.curve.on_s < first_s) ||
           (!guess.curve.sealing && is_free(P::off) && guess.curve.off_s < first_s);
}

/// Every so many samples, enough to choose a start by.
PressureTrace thinned(const PressureTrace& trace) {
    constexpr std::size_t kEnough = 2000;
    const std::size_t stride = trace.t_s.size() / kEnough + 1;
    PressureTrace thin;
    for (std::size_t i = 0; i < trace.t_s.size(); i += stride) {
        thin.t_s.push_back(trace.t_s[i]);
        thin.pressure_Pa.push_back(trace.pressure_Pa[i]);
    }
    return thin;
}

/// The best of all starts: a kink between two samples makes hollows of its own.
Guess best_guess(const PressureTrace& trace, const Stages& stages,
                 const IdentificationOptions& options, bool see_atmosphere) {
    const PressureTrace thin = thinned(trace);
    const double one_more = 1.0 + kPriceOfAKink / static_cast<double>(thin.t_s.size());
    Guess best;
    double least = std::numeric_limits<double>::infinity();
    const std::vector<std::size_t> none = {0};
    for (const std::size_t on : stages.sealing ? stages.on : none) {
        for (const std::size_t off : stages.unsealing ? stages.off : none) {
            Guess guess = guess_of(trace, stages, options, on, off, see_atmosphere);
            double squares = 0.0;
            guess.curve = improved_curve(thin, guess.curve, guess.free, squares);
            if (begins_later(guess, thin)) {
                continue;
            }
            squares *= std::pow(one_more, static_cast<double>(guess.free.size()));
            if (squares < least) {
                least = squares;
                guess.squares_Pa2 = squares;
                best = std::move(guess);
            }
        }
    }
    if (best.free.empty()) {
        throw InputError("the log is too short or too coarse to estimate its time constants");
    }
    return best;
}

/// The strongest line in what the mean curve leaves while the pump runs, if it stands out.
bool add_ripple(const PressureTrace& trace, Guess& guess) {
    constexpr std::size_t kMost = 4000;
    std::vector<double> times_s;
    std::vector<double> left_Pa;
    for (std::size_t i = 0; i < trace.t_s.size() && times_s.size() < kMost; ++i) {
        if (pump_runs(guess.curve, trace.t_s[i])) {
            times_s.push_back(trace.t_s[i]);
            left_Pa.push_back(trace.pressure_Pa[i] - mean_pressure_Pa(guess.curve, trace.t_s[i]));
        }
    }
    if (times_s.size() < kFewestSamples) {
        return false;
    }
    const auto samples = static_cast<Eigen::Index>(times_s.size());
    const Eigen::Map<const Eigen::ArrayXd> t_s(times_s.data(), samples);
    const Eigen::Map<const Eigen::ArrayXd> rest_Pa(left_Pa.data(), samples);
    const double duration_s = times_s.back() - times_s.front();
    const double mean_step_s = duration_s / static_cast<double>(samples - 1);
    const double variance = rest_Pa.square().mean();
    double best_power = 0.0;
    // From three periods in the log to just below Nyquist's frequency, four steps a line's width.
    const int lines = static_cast<int>(1.92 * duration_s / mean_step_s);
    for (int line = 12; line < lines; ++line) {
        const double f_Hz = 0.25 * line / duration_s;
        const Eigen::ArrayXd angle = 2.0 * kPi * f_Hz * (t_s - guess.curve.on_s);
        const double c = (rest_Pa * angle.cos()).mean();
        const double s = (rest_Pa * angle.sin()).mean();
        const double power = (c * c + s * s) * static_cast<double>(samples);
        if (power > best_power) {
            best_power = power;
            guess.curve.ripple_Hz = f_Hz;
            guess.curve.ripple_cos_Pa = 2.0 * c;
            guess.curve.ripple_sin_Pa = 2.0 * s;
        }
    }
    if (!(best_power > kRippleStandsOut * variance)) {
        guess.curve.ripple_Hz = guess.curve.ripple_cos_Pa = guess.curve.ripple_sin_Pa = 0.0;
        return false;
    }
    guess.free.insert(guess.free.end(), {P::ripple_cos, P::ripple_sin, P::ripple_Hz});
    return true;
}

void check_options(const IdentificationOptions& options) {
    for (const auto& given :
         {options.pump_on_s, options.pump_off_s, options.from_s, options.to_s}) {
        if (given && !std::isfinite(*given)) {
            throw InputError("a time that is given must be a finite number");
        }
    }
    if (!(options.atmosphere_Pa > 0.0 && std::isfinite(options.atmosphere_Pa))) {
        throw InputError("the atmosphere must be a finite pressure above zero");
    }
    if (options.pump_on_s && options.pump_off_s && *options.pump_on_s >= *options.pump_off_s) {
        throw InputError("the pump must go on before it goes off");
    }
}

void check(const PressureTrace& trace, const IdentificationOptions& options) {
    if (const std::string suspected =
            suspected_pressure_unit(trace.pressure_Pa, options.atmosphere_Pa);
        !suspected.empty()) {
        throw InputError(suspected);
    }
    constexpr double kLongestStep_s = 3600.0;
    if (median_step_s(trace.t_s) > kLongestStep_s) {
        throw InputError(suspected_time_unit(trace.t_s));
    }
    if (trace.t_s.size() < kFewestSamples) {
        throw InputError(fmt::format("{} samples are too few to fit, at least {} are needed",
                                     trace.t_s.size(), kFewestSamples));
    }
    for (const auto& [name, given] :
         {std::pair("pump on", options.pump_on_s), std::pair("pump off", options.pump_off_s)}) {
        if (given && !(*given >= trace.t_s.front() && *given <= trace.t_s.back())) {
            throw InputError(
                fmt::format("{} at {:g} s is outside the log, which is from {:g} s to {:g} s", name,
                            *given, trace.t_s.front(), trace.t_s.back()));
        }
    }
}

/// What the log holds, once what the user says of it is taken in.
Stages stages_of(const PressureTrace& trace, const IdentificationOptions& options) {
    const std::optional<Stages> found = find_stages(trace);
    if (!found) {
        throw InputError(
            "no change of pressure that stands out of the noise: neither a sealing "
            "nor an unsealing is in it");
    }
    Stages stages = *found;
    if (options.pump_on_s) {
        stages.sealing = true;
        stages.on = {sample_at(trace, *options.pump_on_s)};
    }
    if (options.pump_off_s) {
        stages.unsealing = true;
        stages.off = {sample_at(trace, *options.pump_off_s)};
    }
    if (!stages.sealing && !stages.unsealing) {
        throw InputError("it shows neither a sealing nor an unsealing");
    }
    return stages;
}

/// With its two-sided interval, by Student's t.
std::optional<Fitted> fitted(const CurveFit& fit, CurveParameter parameter) {
    const auto found = std::find(fit.free.begin(), fit.free.end(), parameter);
    if (found == fit.free.end()) {
        return std::nullopt;
    }
    const auto k = static_cast<Eigen::Index>(found - fit.free.begin());
    const boost::math::students_t student(std::max(1.0, fit.freedom[k]));
    return Fitted{.value = fit.curve.*member_of(parameter),
                  .half_width = boost::math::quantile(student, 0.5 + 0.5 * kConfidence) *
                                std::sqrt(fit.covariance(k, k))};
}

PressureFit result_of(const CurveFit& fit, const IdentificationOptions& options) {
    const PressureCurve& curve = fit.curve;
    const auto of = [&](P parameter) { return fitted(fit, parameter); };
    PressureFit result{.atmosphere_Pa = of(P::atmosphere),
                       .vacuum_Pa = of(P::vacuum),
                       .sealing_time_s = of(P::tau_1),
                       .unsealing_time_s = of(P::tau_2),
                       .sealing_begins_s = of(P::on),
                       .unsealing_begins_s = of(P::off),
                       .ripple_Hz = of(P::ripple_Hz),
                       .ripple_Pa = std::hypot(curve.ripple_cos_Pa, curve.ripple_sin_Pa),
                       .residual_Pa = fit.residual_Pa,
                       .memory_s = fit.memory_s,
                       .curve = curve};
    if (!curve.sealing) {
        result.notes.emplace_back("no sealing in the log: tau_1 is not fitted");
    } else if (!curve.baseline) {
        result.notes.emplace_back("the log begins after the pump went on: when is not fitted");
    }
    if (!curve.sealing && !result.unsealing_begins_s && !options.pump_off_s) {
        result.vacuum_Pa.reset();  // it is the pressure of the first sample
        result.notes.emplace_back("the log begins after the pump went off: P_vac is not fitted");
    }
    if (!curve.unsealing) {
        result.notes.emplace_back("no unsealing in the log: tau_2 is not fitted");
    }
    if (curve.unsealing && !result.atmosphere_Pa) {
        result.notes.emplace_back("the log does not show the atmosphere: taken as given");
    }
    return result;
}

/// A stage of which there is next to nothing in the log is not fitted.
void drop_short_stages(const PressureTrace& trace, Stages& stages) {
    const auto few = [&](std::size_t from) {
        return trace.t_s.size() - std::min(from, trace.t_s.size()) < kFewestOfAStage;
    };
    stages.unsealing = stages.unsealing && !few(stages.off.front());
    stages.sealing = stages.sealing && !few(stages.on.front());
    if (!stages.sealing && !stages.unsealing) {
        throw InputError("fewer than 8 samples after the change of pressure: too few to fit");
    }
}

/// From a mean curve to one with ripple, and its covariance.
CurveFit fitted_curve(const PressureTrace& trace, Stages stages,
                      const IdentificationOptions& options) {
    Guess guess = best_guess(trace, stages, options, false);
    if (stages.may_unseal && !stages.unsealing) {
        stages.unsealing = true;
        Guess risen = best_guess(trace, stages, options, false);
        // A pump that comes and goes also rises at times, but that leaves as much as before.
        if (risen.squares_Pa2 < 0.5 * guess.squares_Pa2) {
            guess = std::move(risen);
        }
    }
    const bool sees_atmosphere = guess.curve.unsealing && !guess.curve.baseline &&
                                 trace.t_s.back() - guess.curve.off_s > 2.0 * guess.curve.tau_2_s;
    if (sees_atmosphere) {
        guess = best_guess(trace, stages, options, true);
    }
    const bool ripples = add_ripple(trace, guess);
    CurveFit fit = fit_curve(trace, guess.curve, guess.free);
    if (!fit.regular && ripples) {  // a line that the whole trace does not bear out
        guess.free.resize(guess.free.size() - 3);
        guess.curve.ripple_Hz = guess.curve.ripple_cos_Pa = guess.curve.ripple_sin_Pa = 0.0;
        fit = fit_curve(trace, guess.curve, guess.free);
    }
    if (!fit.regular) {
        throw InputError("the log is too short or too coarse to estimate its time constants");
    }
    return fit;
}

}  // namespace

PressureFit identify_pressure(const PressureTrace& trace, const IdentificationOptions& options) {
    require(trace.t_s.size() == trace.pressure_Pa.size(), "a pressure for every time");
    require(std::is_sorted(trace.t_s.begin(), trace.t_s.end()), "a trace's times rise");
    check_options(options);
    const std::size_t first = options.from_s ? sample_at(trace, *options.from_s) : 0;
    const std::size_t end = options.to_s ? sample_at(trace, *options.to_s) : trace.t_s.size();
    const PressureTrace selected = samples_of(trace, first, std::max(first, end) - first);
    check(selected, options);
    const double first_s = selected.t_s.front();
    const PressureTrace moved = from_first_sample(selected);
    const IdentificationOptions moved_options = earlier(options, first_s);
    Stages stages = stages_of(moved, moved_options);
    if (options.pump_off_s && stages.used > 0 &&
        *options.pump_off_s > selected.t_s[stages.used - 1]) {
        stages.used = selected.t_s.size();  // the user knows better where it ends
    }
    const PressureTrace used = samples_of(moved, 0, stages.used);
    drop_short_stages(used, stages);

    PressureFit result = result_of(fitted_curve(used, stages, moved_options), moved_options);
    go_later(result, first_s);
    result.first_sample = first;
    result.samples = used.t_s.size();
    if (used.t_s.size() < selected.t_s.size()) {
        result.notes.push_back(
            fmt::format("the log seals again at {:g} s: only what is before was used",
                        selected.t_s[used.t_s.size() - 1]));
    }
    if (const std::string suspected = suspected_time_unit(selected.t_s); !suspected.empty()) {
        result.notes.push_back(suspected);
    }
    return result;
}

}  // namespace limpet::identification
