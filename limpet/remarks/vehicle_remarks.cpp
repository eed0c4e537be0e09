// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limpet/remarks/digits.hpp"
#include "limpet/remarks/remarks.hpp"
#include "limpet/vehicle/airframe.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::remarks {
namespace {

using vehicle::Airframe;

bool within(double value, double usual, double factor) {
    return value > usual / factor && value < usual * factor;
}

/// A vehicle and what its file says of it.
class Remarks {
public:
    Remarks(const Airframe& airframe, const std::vector<std::string>& inherited)
        : airframe_(airframe),
          inherited_(inherited),
          mass_kg_(carried_mass_kg(airframe)),
          reach_m_(hubs_reach_m(airframe)) {}

    std::vector<std::string> take() {
        arms();
        inertia();
        hover();
        if (airframe_.has_cup) {
            slider();
            hinges();
            reach_ahead();
            legs();
        }
        return std::move(all_);
    }

private:
    template <class... Args>
    void say(fmt::format_string<const Args&...> text, const Args&... args) {
        all_.push_back(fmt::format(text, args...));
    }
    [[nodiscard]] bool is_inherited(std::string_view key) const {
        return std::find(inherited_.begin(), inherited_.end(), key) != inherited_.end();
    }
    /// Those that the file leaves out.
    [[nodiscard]] std::vector<std::string> left_out(std::vector<std::string> keys) const {
        std::erase_if(keys, [this](const std::string& key) { return !is_inherited(key); });
        return keys;
    }
    [[nodiscard]] std::string where(std::string_view key) const {
        return is_inherited(key) ? fmt::format("{} is not given, so it is the {:.3g} kg vehicle's",
                                               key, Airframe().mass_kg)
                                 : std::string(key);
    }

    /// Of multirotors from 27 g to 11 kg the furthest hub is some 0.2 m/kg^(1/3) out.
    void arms() {
        constexpr double kReach_m = 0.2, kFactor = 1.6;
        const double usual_m = kReach_m * std::cbrt(mass_kg_);
        if (is_inherited("rotors") && !within(reach_m_, usual_m, kFactor)) {
            say("{}: hubs {} m out; a vehicle of {:.3g} kg has some {}", where("rotors"),
                about(reach_m_), mass_kg_, about(usual_m));
        }
    }

    void inertia() {
        const bool unsaid = is_inherited("inertia_kg_m2.xx") || is_inherited("inertia_kg_m2.yy") ||
                            is_inherited("inertia_kg_m2.zz");
        const double factor = unsaid ? 2.5 : 6.0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!is_plausible_inertia(airframe_, airframe_.inertia_kg_m2[axis], axis, factor)) {
                const Vector3 usual = usual_inertia_kg_m2(airframe_);
                const Vector3& has = airframe_.inertia_kg_m2;
                say("inertia_kg_m2 is {}[{}, {}, {}]; a vehicle of {:.3g} kg with its hubs {} m "
                    "out has some [{}, {}, {}]",
                    unsaid ? "not given, so it is " : "", about(has.x()), about(has.y()),
                    about(has.z()), mass_kg_, about(reach_m_), about(usual.x()), about(usual.y()),
                    about(usual.z()));
                return;
            }
        }
    }

    /// Space below and above for what turns and climbs.
    void hover() {
        constexpr double kLeast = 0.25, kMost = 0.85;
        const double command = hover_command(airframe_);
        if (command >= kLeast && command <= kMost) {
            return;
        }
        const std::vector<std::string> keys =
            left_out({"rotor.motor_constant_kg_m", "rotor.speed_scale_rad_s",
                      "rotor.speed_offset_rad_s", "rotor.speed_max_rad_s"});
        say("it hovers at motor command {:.2f}, which leaves little reserve {}: {}", command,
            command < kLeast ? "below" : "above",
            keys.empty() ? "rotor.motor_constant_kg_m, rotor.speed_scale_rad_s, mass_kg"
                         : fmt::format("{} not given, so the {:.3g} kg vehicle's",
                                       fmt::join(keys, ", "), Airframe().mass_kg));
    }

    /// m x'' + c x' + k x = 0 moves alike where k and c go with m.
    void slider() {
        constexpr double kFactor = 1.7;
        const Airframe paper;
        const double share = mass_kg_ / paper.mass_kg;
        const std::vector<std::string> keys =
            left_out({"slider.stiffness_N_m", "slider.damping_N_s_m", "slider.preload_N"});
        const bool moves =
            is_inherited("slider.stiffness_N_m") || is_inherited("slider.damping_N_s_m");
        if (moves && !within(share, 1.0, kFactor)) {
            say("{} not given, so the {:.3g} kg vehicle's; with {:.3g} kg the slider moves as its "
                "does at some {} N/m, {} N s/m, {} N",
                fmt::format("{}", fmt::join(keys, ", ")), paper.mass_kg, mass_kg_,
                about(share * paper.slider.stiffness_N_m),
                about(share * paper.slider.damping_N_s_m), about(share * paper.slider.preload_N));
        }
    }

    /// The lip bears a moment that goes with the cube of its radius.
    void hinges() {
        constexpr double kFactor = 1.3, kVacuum_Pa = 6e4, kAim = 3.0;
        constexpr const char* kKey = "cup.centring_stiffness_N_m_rad";
        const double radius_m = airframe_.cup.radius_m;
        if (!is_inherited(kKey) || within(radius_m, Airframe().cup.radius_m, kFactor)) {
            return;
        }
        const double peels_N_m = 0.5 * kVacuum_Pa * kPi * std::pow(radius_m, 3);
        const double usual = peels_N_m / (kAim * pitch_on_legs_rad(airframe_));
        if (!within(airframe_.cup.centring_stiffness_N_m_rad, usual, 2.0) &&
            airframe_.cup.centring_stiffness_N_m_rad > usual) {
            say("{} is not given, so it is an 80 mm cup's {}; the lip of one of {:.0f} mm peels at "
                "{} N m (600 hPa of vacuum): at most some {}",
                kKey, about(airframe_.cup.centring_stiffness_N_m_rad), 2e3 * radius_m,
                about(peels_N_m), about(usual, 1));
        }
    }

    /// The cup meets the wall before the propellers do, and not far before them.
    void reach_ahead() {
        constexpr double kFar = 3.0;
        double tips_m = 0.0;
        for (const vehicle::Rotor& rotor : airframe_.rotors) {
            tips_m = std::max(tips_m, rotor.p_B_m.x() + airframe_.rotor.radius_m);
        }
        const double lip_m = airframe_.cup.joint_x_m + airframe_.cup.lip_offset_m;
        if (lip_m <= tips_m) {
            say("{}: the lip is {:.3g} m ahead, the propellers' tips are {:.3g}: they meet the "
                "wall "
                "first",
                where("cup.joint_x_m"), lip_m, tips_m);
        } else if (is_inherited("cup.joint_x_m") && lip_m > kFar * reach_m_) {
            say("{}: the lip is {:.3g} m ahead, {:.1f} times as far as the hubs",
                where("cup.joint_x_m"), lip_m, lip_m / reach_m_);
        }
    }

    void legs() {
        constexpr double kLong = 2.0, kLeast_deg = 25.0, kMost_deg = 85.0;
        const vehicle::LegParameters& legs = airframe_.legs;
        const double length_m = std::hypot(legs.tip_x_m, legs.tip_z_m);
        const double pitch_deg = degrees(pitch_on_legs_rad(airframe_));
        if (length_m > kLong * reach_m_) {
            say("{}: the legs reach {} m, {:.1f} times as far as the hubs", where("legs.tip_z_m"),
                about(length_m), length_m / reach_m_);
        } else if (pitch_deg < kLeast_deg || pitch_deg > kMost_deg) {
            say("{}: on its legs it would stand at {:.0f} deg of pitch", where("legs.tip_z_m"),
                pitch_deg);
        }
    }

    const Airframe& airframe_;
    const std::vector<std::string>& inherited_;
    double mass_kg_;
    double reach_m_;
    std::vector<std::string> all_;
};

}  // namespace

std::vector<std::string> vehicle_remarks(const Airframe& airframe,
                                         const std::vector<std::string>& inherited) {
    return Remarks(airframe, inherited).take();
}

}  // namespace limpet::remarks
