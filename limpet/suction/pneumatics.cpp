// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pneumatics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::suction {
namespace {

constexpr double kGasConstantTimesTemperature_m2_s2 = 287.05 * 293.15;  ///< dry air, 20 deg C
constexpr double kRatioOfHeats = 1.4;
constexpr double kDischarge = 0.6;           ///< assumed: sharp-edged hole
constexpr double kLaminarRatio = 0.999;      ///< of pressures, above it orifices are linear
constexpr double kViscosity_Pa_s = 1.81e-5;  ///< of air at 20 deg C
constexpr double kFriction = 0.03;           ///< assumed: Darcy, smooth hose at Re 1e4
constexpr double kEndLosses = 1.5;           ///< assumed: sharp inlet 0.5, outlet 1
constexpr double kLeakReference_N = 100.0;   ///< clamping at which a surface's leak is given
constexpr double kLipPreload_N = 5.0;        ///< N_0, assumed: the lip's own spring
constexpr double kPiece_s = 1e-3;
constexpr std::size_t kMostCups = 16;

/// psi of orifice flow: throughput over A P sqrt(R T).
double flow_function(double ratio) {
    constexpr double k = kRatioOfHeats;
    const double critical = std::pow(2.0 / (k + 1.0), k / (k - 1.0));
    const double r = std::max(ratio, critical);
    return std::sqrt(2.0 * k / (k - 1.0) * (std::pow(r, 2.0 / k) - std::pow(r, (k + 1.0) / k)));
}

/// P^2 - P_m^2 that a throughput takes, and its slope.
struct HoseDrop {
    double drop_Pa2;
    double slope_Pa_s_m3;
};
HoseDrop hose_drop(const Hose& hose, double flow_Pa_m3_s) {
    const double laminar2 = hose.laminar_Pa_s_m3 * hose.laminar_Pa_s_m3;
    const double turbulent = hose.turbulent_s2_m6 * flow_Pa_m3_s;
    const double sum = laminar2 * laminar2 + std::pow(turbulent, 4);
    const double friction = std::sqrt(std::sqrt(sum));
    return {(friction + hose.ends_s2_m6 * flow_Pa_m3_s) * flow_Pa_m3_s,
            friction * (1.0 + std::pow(turbulent, 4) / sum) + 2.0 * hose.ends_s2_m6 * flow_Pa_m3_s};
}

/// Flow from cup to manifold, and its slopes; odd and smooth in P^2 - P_m^2.
struct HoseFlow {
    double flow_Pa_m3_s;
    double by_cup, by_manifold;  ///< slopes [m^3/s]
};
HoseFlow hose_flow(const Hose& hose, double cup_Pa, double manifold_Pa) {
    if (hose.blocked()) {
        return {0.0, 0.0, 0.0};
    }
    const double signed_Pa2 = (cup_Pa - manifold_Pa) * (cup_Pa + manifold_Pa);
    const double drop_Pa2 = std::abs(signed_Pa2);
    // The drop is convex in the flow and either limit alone lets more through: Newton's steps come
    // down to the flow from there.
    double flow = std::min(drop_Pa2 / hose.laminar_Pa_s_m3,
                           std::sqrt(drop_Pa2 / (hose.turbulent_s2_m6 + hose.ends_s2_m6)));
    HoseDrop at = hose_drop(hose, flow);
    for (int k = 0; k < 20 && at.drop_Pa2 - drop_Pa2 > 1e-14 * drop_Pa2; ++k) {
        flow -= (at.drop_Pa2 - drop_Pa2) / at.slope_Pa_s_m3;
        at = hose_drop(hose, flow);
    }
    return {std::copysign(flow, signed_Pa2), 2.0 * cup_Pa / at.slope_Pa_s_m3,
            -2.0 * manifold_Pa / at.slope_Pa_s_m3};
}

/// What the pump takes, above what the hoses bring; rises with the manifold's pressure.
struct Balance {
    double excess_Pa_m3_s;
    double slope_m3_s;
};
Balance balance(const Pump& pump, std::span<const CupAir> cups, std::span<const double> pressures,
                double manifold_Pa) {
    Balance sum{0.0, 0.0};
    if (pump.running && manifold_Pa > pump.ultimate_Pa) {
        sum = {pump.speed_m3_s * (manifold_Pa - pump.ultimate_Pa), pump.speed_m3_s};
    }
    for (std::size_t k = 0; k < cups.size(); ++k) {
        const HoseFlow hose = hose_flow(cups[k].hose, pressures[k], manifold_Pa);
        sum.excess_Pa_m3_s -= hose.flow_Pa_m3_s;
        sum.slope_m3_s -= hose.by_manifold;
    }
    return sum;
}

double clamped_leak_m3_s(double at_100_N_m3_s, double exponent, double clamping_N) {
    return at_100_N_m3_s *
           std::pow((kLeakReference_N + kLipPreload_N) / (clamping_N + kLipPreload_N), exponent);
}

/// dP/dt of one cup but for the hose, times its volume, and the slope of it by P.
struct Inflow {
    double flow_Pa_m3_s;
    double slope_m3_s;
};
Inflow inflow(const CupAir& cup, double pressure_Pa) {
    const double vacuum_Pa = cup.ambient_Pa - pressure_Pa;
    const double clamping_N = std::max(0.0, vacuum_Pa * cup.area_m2 + cup.press_N);
    double leak_m3_s = clamped_leak_m3_s(cup.leak_100_m3_s, cup.leak_exponent, clamping_N);
    double exponent = cup.leak_exponent;  // with which the leak falls, here
    if (cup.uneven_N > 0.0) {
        const double grade = cup.uneven_N / (clamping_N + kLipPreload_N);
        const GradedLeak graded = graded_leak(cup.leak_exponent, grade);
        leak_m3_s *= graded.ratio;
        exponent += grade * graded.by_grade / graded.ratio;
    }
    const double loosening =
        clamping_N > 0.0 ? exponent * cup.area_m2 * vacuum_Pa / (clamping_N + kLipPreload_N) : 0.0;
    Inflow in{(leak_m3_s + cup.off_wall_m3_s) * vacuum_Pa,
              leak_m3_s * (loosening - 1.0) - cup.off_wall_m3_s};
    if (cup.hole_m2 > 0.0) {
        constexpr double kStep_Pa = 1.0;
        const double here = orifice_flow_Pa_m3_s(cup.hole_m2, cup.ambient_Pa, pressure_Pa);
        const double there =
            orifice_flow_Pa_m3_s(cup.hole_m2, cup.ambient_Pa, pressure_Pa + kStep_Pa);
        in.flow_Pa_m3_s += here;
        in.slope_m3_s += (there - here) / kStep_Pa;
    }
    return in;
}

/// Numbers of all cups.
using Cups = std::array<double, kMostCups>;

/// The law made linear: dP/dt = slope + J (P - now), J = diag(own) + by_manifold follows'.
struct Linear {
    std::size_t count = 0;
    Cups rate_Pa_s{};
    Cups own{};          ///< of each cup alone, the manifold held [1/s]
    Cups by_manifold{};  ///< of each cup by the manifold's pressure [1/s]
    Cups follows{};      ///< of the manifold's pressure by each cup's
};

Linear linear_law(const Pump& pump, std::span<const CupAir> cups,
                  std::span<const double> pressures_Pa) {
    const double manifold_Pa = manifold_pressure_Pa(pump, cups, pressures_Pa);
    const double slope_m3_s = balance(pump, cups, pressures_Pa, manifold_Pa).slope_m3_s;
    Linear law;
    law.count = cups.size();
    for (std::size_t k = 0; k < cups.size(); ++k) {
        const Inflow in = inflow(cups[k], pressures_Pa[k]);
        const HoseFlow hose = hose_flow(cups[k].hose, pressures_Pa[k], manifold_Pa);
        // d(P V)/dP: as the air leaves, the volume does too.
        const double give_m3_Pa = cups[k].gives_way_m3 / cups[k].ambient_Pa;
        const double volume_m3 =
            cups[k].volume_m3 + give_m3_Pa * (2.0 * pressures_Pa[k] - cups[k].ambient_Pa);
        law.rate_Pa_s[k] = (in.flow_Pa_m3_s - hose.flow_Pa_m3_s) / volume_m3;
        law.own[k] =
            (in.slope_m3_s - hose.by_cup - 2.0 * give_m3_Pa * law.rate_Pa_s[k]) / volume_m3;
        law.by_manifold[k] = -hose.by_manifold / volume_m3;
        law.follows[k] = slope_m3_s > 0.0 ? hose.by_cup / slope_m3_s : 0.0;
    }
    return law;
}

/// x = (1 - g J)^-1 x, by Sherman's and Morrison's formula.
void solve(const Linear& law, double g_s, Cups& x) {
    Cups u{};
    double along_x = 0.0;
    double along_u = 0.0;
    for (std::size_t k = 0; k < law.count; ++k) {
        const double diagonal = std::max(0.1, 1.0 - g_s * law.own[k]);
        x[k] /= diagonal;
        u[k] = g_s * law.by_manifold[k] / diagonal;
        along_x += law.follows[k] * x[k];
        along_u += law.follows[k] * u[k];
    }
    for (std::size_t k = 0; k < law.count; ++k) {
        x[k] += u[k] * along_x / (1.0 - along_u);
    }
}

/// P += h (1 - g h J)^-2 (1 - a h J) f: exact to the second order, and what is fast is damped
/// (its stability function falls to 0): g = 1 - 1/sqrt(2), a = 2 g - 1/2.
void advance_piece(const Pump& pump, std::span<const CupAir> cups, std::span<double> pressures_Pa,
                   double dt_s) {
    const double g = 1.0 - std::sqrt(0.5);
    const double a = 2.0 * g - 0.5;
    const Linear law = linear_law(pump, cups, pressures_Pa);
    double manifold_rate = 0.0;
    for (std::size_t k = 0; k < law.count; ++k) {
        manifold_rate += law.follows[k] * law.rate_Pa_s[k];
    }
    Cups step{};
    for (std::size_t k = 0; k < law.count; ++k) {
        const double bend = law.own[k] * law.rate_Pa_s[k] + law.by_manifold[k] * manifold_rate;
        step[k] = law.rate_Pa_s[k] - a * dt_s * bend;
    }
    solve(law, g * dt_s, step);
    solve(law, g * dt_s, step);
    // Between the pump's and the atmosphere's all pressures stay, however wide a hole is.
    const auto [least, most] = std::minmax_element(pressures_Pa.begin(), pressures_Pa.end());
    const double floor_Pa = std::min(*least, pump.ultimate_Pa);
    const double ceiling_Pa = std::max(*most, cups.front().ambient_Pa);
    for (std::size_t k = 0; k < law.count; ++k) {
        pressures_Pa[k] = std::clamp(pressures_Pa[k] + dt_s * step[k], floor_Pa, ceiling_Pa);
    }
}

/// What a pull adds to a soft cup's volume.
double stretched_m3(const PneumaticParameters& parameters, double press_N) {
    return 1e-6 * parameters.cup_stretch_cm3_N * std::max(0.0, -press_N);
}

/// As much air in a cup whose volume without a vacuum was another before: P V is kept, of which the
/// vacuum itself squeezes out its part. A lip lets out what is above the atmosphere.
double stretched_Pa(const CupAir& cup, double before_m3, double pressure_Pa) {
    const double give_m3_Pa = cup.gives_way_m3 / cup.ambient_Pa;
    const double air_Pa_m3 =
        pressure_Pa * (before_m3 - give_m3_Pa * (cup.ambient_Pa - pressure_Pa));
    const double squeezed_m3 = cup.volume_m3 - cup.gives_way_m3;
    const double here_Pa =
        2.0 * air_Pa_m3 /
        (squeezed_m3 + std::sqrt(squeezed_m3 * squeezed_m3 + 4.0 * give_m3_Pa * air_Pa_m3));
    return std::min(here_Pa, std::max(pressure_Pa, cup.ambient_Pa));
}

}  // namespace

const ParameterTable<PneumaticParameters>& Pneumatic::table() {
    using P = PneumaticParameters;
    static const ParameterTable<P> table = {
        {"pump_speed_L_min", "L/min", 0.0, 1e3, &P::pump_speed_L_min,
         "pneumatic: pumping speed; free flow is 1 - pump_ultimate/P_atm of it",
         "assumed: common 12 V diaphragm pump, facts.md section 3"},
        {"pump_ultimate_Pa", "Pa", 100.0, 1e5, &P::pump_ultimate_Pa,
         "pneumatic: the pump takes nothing below it", "fitted to Table II, facts.md section 3"},
        {"pump_stop_Pa", "Pa", 100.0, 101325.0, &P::pump_stop_Pa,
         "pneumatic: vacuum switch, an attached cup's pump rests below it",
         "fitted to Table II: only metal passes it, 275 hPa is in the middle"},
        {"pump_restart_Pa", "Pa", 100.0, 101325.0, &P::pump_restart_Pa,
         "pneumatic: and starts again above it", "as pump_stop_Pa"},
        {"cup_volume_cm3", "cm^3", 0.1, 1e5, &P::cup_volume_cm3, "pneumatic: air in cup and hose",
         "assumed: 80 mm cup 12 mm high; with the pump it gives tau_1 of the blade"},
        {"cup_gives_way", "-", 0.0, 1.0, &P::cup_gives_way,
         "pneumatic: share of cup_volume_cm3 that a full vacuum squeezes out of a soft cup or "
         "bellows, in proportion; at 1 with a pump that goes far down the pressure falls in a line",
         "assumed: 0, rigid; a drone's cup on a wall fell in a line (data/others/sealing.yaml)"},
        {"cup_stretch_cm3_N", "cm^3/N", 0.0, 10.0, &P::cup_stretch_cm3_N,
         "pneumatic: volume that each newton of pull adds to a soft cup, whose pressure falls "
         "again: it clings without a pump until its leak fills it",
         "assumed: 0, rigid; the lip's spring of 20 kN/m under 50 cm^2 gives 0.25, bellows ten "
         "times that"},
        {"valve_bore_mm", "mm", 0.0, 100.0, &P::valve_bore_mm, "pneumatic: the open valve's bore",
         "facts.md item 20: 2 mm on 60 cm^3"},
        {"hose_bore_mm", "mm", 0.0, 100.0, &P::hose_bore_mm,
         "pneumatic: inner diameter of the hose from cup to pump; 0: blocked",
         "assumed: common 6x4 mm hose"},
        {"hose_length_m", "m", 0.0, 100.0, &P::hose_length_m,
         "pneumatic: its length; 0: an orifice of that bore",
         "assumed: from the cup to the pump at the back"},
        {"graded_seal", "switch", 0.0, 1.0, &P::graded_seal,
         "pneumatic: a moment on the lip presses one side more than the other, and the whole leaks "
         "more, where a surface's leak closes as it is pressed",
         "assumed: off, the leaks are fitted to Table II without it"},
        {"partial_seal_area_mm2", "mm^2", 0.0, 1e4, &P::partial_seal_area_mm2,
         "pneumatic: open area where the lip does not meet the wall", "assumed: a whole seal"},
    };
    return table;
}

double leak_conductance_m3_s(const Surface& surface, double clamping_N) {
    return clamped_leak_m3_s(1e-6 * surface.leak_conductance_cm3_s, surface.leak_clamping_exponent,
                             std::max(0.0, clamping_N));
}

double orifice_flow_Pa_m3_s(double area_m2, double upstream_Pa, double downstream_Pa) {
    if (downstream_Pa > upstream_Pa) {
        return -orifice_flow_Pa_m3_s(area_m2, downstream_Pa, upstream_Pa);
    }
    static const double full = kDischarge * std::sqrt(kGasConstantTimesTemperature_m2_s2);
    const double ratio = downstream_Pa / upstream_Pa;
    const double psi = ratio <= kLaminarRatio
                           ? flow_function(ratio)
                           : flow_function(kLaminarRatio) * (1.0 - ratio) / (1.0 - kLaminarRatio);
    return full * area_m2 * upstream_Pa * psi;
}

Hose hose_of(double bore_mm, double length_m) {
    const double bore_m = 1e-3 * bore_mm;
    if (bore_m <= 0.0) {
        return {};
    }
    const double creeping_m = length_m + 3.0 * kPi / 16.0 * bore_m;
    const double area_m2 = 0.25 * kPi * bore_m * bore_m;
    const double head_s2_m6 = 1.0 / (area_m2 * area_m2 * kGasConstantTimesTemperature_m2_s2);
    return {.laminar_Pa_s_m3 = 256.0 * kViscosity_Pa_s * creeping_m / (kPi * std::pow(bore_m, 4)),
            .turbulent_s2_m6 = kFriction * length_m / bore_m * head_s2_m6,
            .ends_s2_m6 = kEndLosses * head_s2_m6};
}

double hose_flow_Pa_m3_s(const Hose& hose, double cup_Pa, double manifold_Pa) {
    return hose_flow(hose, cup_Pa, manifold_Pa).flow_Pa_m3_s;
}

GradedLeak graded_leak(double exponent, double grade) {
    constexpr int kPoints = 64;
    constexpr double kMost = 0.98;
    const double e = std::min(grade, kMost);
    GradedLeak leak{0.0, 0.0};
    for (int k = 0; k < kPoints; ++k) {
        const double cosine = std::cos(2.0 * kPi * (k + 0.5) / kPoints);
        const double part = std::pow(1.0 + e * cosine, -exponent) / kPoints;
        leak.ratio += part;
        leak.by_grade -= exponent * part * cosine / (1.0 + e * cosine);
    }
    leak.by_grade = grade < kMost ? leak.by_grade : 0.0;
    return leak;
}

Pump pump_of(const PneumaticParameters& parameters, bool running) {
    return {.speed_m3_s = parameters.pump_speed_L_min / 60e3,
            .ultimate_Pa = parameters.pump_ultimate_Pa,
            .running = running};
}

CupAir sealed_cup(const PneumaticParameters& parameters, const Surface& surface, double radius_m,
                  double press_N, bool valve_open) {
    const double valve_m = valve_open ? 1e-3 * parameters.valve_bore_mm : 0.0;
    const double cup_m3 = 1e-6 * parameters.cup_volume_cm3;
    return {.volume_m3 = 1e-6 * (parameters.cup_volume_cm3 + surface.pore_volume_cm3) +
                         stretched_m3(parameters, press_N),
            .gives_way_m3 = parameters.cup_gives_way * cup_m3,
            .hose = hose_of(parameters.hose_bore_mm, parameters.hose_length_m),
            .leak_100_m3_s = leak_conductance_m3_s(surface, kLeakReference_N),
            .leak_exponent = surface.leak_clamping_exponent,
            .area_m2 = kPi * radius_m * radius_m,
            .press_N = press_N,
            .hole_m2 = 1e-6 * parameters.partial_seal_area_mm2 + 0.25 * kPi * valve_m * valve_m};
}

CupAir cup_off_the_wall(const PneumaticParameters& parameters, double time_constant_s) {
    const double volume_m3 = 1e-6 * parameters.cup_volume_cm3;
    return {.volume_m3 = volume_m3,
            .hose = hose_of(parameters.hose_bore_mm, parameters.hose_length_m),
            .off_wall_m3_s = volume_m3 / time_constant_s};
}

double manifold_pressure_Pa(const Pump& pump, std::span<const CupAir> cups,
                            std::span<const double> pressures_Pa) {
    require(!cups.empty() && cups.size() == pressures_Pa.size(), "a pressure for every cup");
    const auto [least, most] = std::minmax_element(pressures_Pa.begin(), pressures_Pa.end());
    double low_Pa = pump.running ? std::min(*least, pump.ultimate_Pa) : *least;
    double high_Pa = *most;
    double manifold_Pa = high_Pa;
    // Newton's step while it stays between what is known, halving otherwise.
    for (int k = 0; k < 60 && high_Pa - low_Pa > 1e-7; ++k) {
        const Balance at = balance(pump, cups, pressures_Pa, manifold_Pa);
        (at.excess_Pa_m3_s > 0.0 ? high_Pa : low_Pa) = manifold_Pa;
        const double step_Pa = at.slope_m3_s > 0.0 ? at.excess_Pa_m3_s / at.slope_m3_s : 0.0;
        const double next_Pa = manifold_Pa - step_Pa;
        const bool inside = at.slope_m3_s > 0.0 && next_Pa >= low_Pa && next_Pa <= high_Pa;
        manifold_Pa = inside ? next_Pa : 0.5 * (low_Pa + high_Pa);
        if (inside && std::abs(step_Pa) < 1e-7) {
            break;
        }
    }
    return manifold_Pa;
}

void advance_network(const Pump& pump, std::span<const CupAir> cups, std::span<double> pressures_Pa,
                     double dt_s) {
    require(cups.size() <= kMostCups, "no more than 16 cups on a pump");
    const int pieces = std::max(1, static_cast<int>(std::ceil(dt_s / kPiece_s - 1e-9)));
    for (int k = 0; k < pieces; ++k) {
        advance_piece(pump, cups, pressures_Pa, dt_s / pieces);
    }
}

double pressure_after(const Pump& pump, const CupAir& cup, double pressure_Pa, double dt_s) {
    advance_network(pump, std::span(&cup, 1), std::span(&pressure_Pa, 1), dt_s);
    return pressure_Pa;
}

bool Pneumatic::pump_rests(const Parameters& parameters, const SealedAir& air) {
    return air.pressure_Pa < parameters.pump_stop_Pa ||
           (air.pump_resting && air.pressure_Pa < parameters.pump_restart_Pa);
}

double Pneumatic::next_Pa(const Parameters& parameters, const SealedAir& air, double dt_s) {
    CupAir cup = sealed_cup(parameters, air.surface, air.radius_m, air.press_N, air.valve_open);
    cup.hole_m2 += 1e-6 * air.hole_mm2;
    cup.ambient_Pa = air.ambient_Pa;
    cup.leak_100_m3_s *= 1.0 + air.leak_growth;
    cup.uneven_N = parameters.graded_seal ? 2.0 * air.peel_N_m / air.radius_m : 0.0;
    const double before_m3 = cup.volume_m3 - stretched_m3(parameters, air.press_N) +
                             stretched_m3(parameters, air.press_before_N);
    const double pressure_Pa = before_m3 == cup.volume_m3
                                   ? air.pressure_Pa
                                   : stretched_Pa(cup, before_m3, air.pressure_Pa);
    return pressure_after(pump_of(parameters, air.pump_running), cup, pressure_Pa, dt_s);
}

}  // namespace limpet::suction
