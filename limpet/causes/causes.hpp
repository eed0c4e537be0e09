// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "limpet/core/random.hpp"
#include "limpet/stability/map.hpp"
#include "limpet/statistics/shares.hpp"
#include "limpet/study/posterior.hpp"

/// Why the paper's real vehicle swings while it waits and its simulation does not, with
/// probabilities: what it does not publish is drawn from ranges with sources, what it does say
/// weighs the draws.
namespace limpet::causes {

/// Places of the inputs in a point, in the order of cause_inputs().
enum CausePlace : Eigen::Index {
    kLag = 0,
    kRatio,
    kDelay,
    kJointX,
    kJointZ,
    kInertia,
    kRateK,
    kRateI,
    kAttitudeP,
    kGyro,
    kDerivative,
    kStiffness,
    kDamping,
    kCentring,
    kTilt,
    kMoment,
    kCorrelation,
    kShared,
    kPlaces,
};
inline constexpr Eigen::Index kOfLoop = kMoment;  ///< those before are the loop's

/// What differs between the simulation and the vehicle, or was published of neither.
enum class Cause {
    motors,    ///< slower than Gazebo's
    delay,     ///< of the speed controllers and of the pipeline from gyro to output
    arm,       ///< where the cup's joint is, and the inertia
    gains,     ///< of the attitude loop and its filters, in the vehicle and its simulation alike
    joint,     ///< slider, cup's joint and lip
    wall_air,  ///< unsteady moment of the wake at the wall
};
inline constexpr std::size_t kCauses = 6;
/// "motors", "dead time", ...
[[nodiscard]] const char* to_text(Cause cause);

/// A number that the paper does not publish.
struct CauseInput {
    CausePlace place;               ///< in a point
    std::string name;               ///< for people, with its unit
    std::vector<std::string> keys;  ///< of a scenario, that it is set to; empty: not the loop's
    Cause cause;
    double as_simulated;  ///< what the paper's simulation has, or the scenario
    std::string prior;    ///< for people: "0.40 … 0.58"
    std::string source;   ///< of the prior
    double (*draw)(RandomStream& random);
};
[[nodiscard]] const std::vector<CauseInput>& cause_inputs();
/// Numbers of all inputs, in their order.
using CausePoint = Eigen::VectorXd;
/// What the paper's simulation flew.
[[nodiscard]] CausePoint as_simulated();
/// Inputs of the causes that take part from their priors, others as simulated.
[[nodiscard]] CausePoint draw_point(std::size_t subset, RandomStream& random);
[[nodiscard]] inline bool takes_part(std::size_t subset, Cause cause) {
    return ((subset >> static_cast<std::size_t>(cause)) & 1U) != 0;
}
/// `--set` texts that make a scenario a point.
[[nodiscard]] stability::Overrides overrides_of(const CausePoint& point);

/// The swing of a point by the linearised loop.
struct PointSwing {
    static constexpr double kNone_1_s = -5.0;  ///< growth where nothing swings: over at once
    bool rests = false;                        ///< there is a rest to wait at
    double growth_1_s = kNone_1_s;
    double frequency_Hz = 0.0;
};
/// @param linear  in place of the linearised loop
[[nodiscard]] PointSwing swing_of(const CausePoint& point,
                                  const stability::SwingOf& linear = stability::linear_swing);

/// How large the swing becomes while the vehicle waits at one wall. What settling and noise show of
/// it stays; what it begins with grows and is pushed by the wall's air. A flight's swing is that
/// with a factor exp(s z), z standard normal.
struct WaitSize {
    double settled_deg = 0.0;
    double start_deg = 0.2;
    double scatter = 0.5;           ///< s of what does not grow
    double growth_error_1_s = 0.0;  ///< of the linearised loop's growth, what grows scatters by it
};
/// The middle of many flights [deg], and the scatter of its logarithm.
struct ExpectedSwing {
    double middle_deg = 0.0;
    double scatter = 0.0;
    /// That a flight's swing lies between two ends, `from` >= 0.
    [[nodiscard]] double probability(double from_deg, double to_deg) const;
};
/// Largest amplitude of the pitch in waiting for so long.
[[nodiscard]] ExpectedSwing expected_swing(const WaitSize& size, const CausePoint& point,
                                           const PointSwing& swing, double waited_s);
struct SwingSize {
    WaitSize metal, concrete;
    std::size_t flights = 0;  ///< by which these were found
    double held = 0.0;        ///< share of other flights within its 95 %
    double without_figure =
        0.0;  ///< share of all that show no swing: never docked, crashed, came off
};
/// Whole missions at points of the prior, each of a set of its own: one half to fit size and
/// scatter by maximum likelihood, the other to be held against them.
[[nodiscard]] SwingSize measure_size(std::size_t points, int jobs);

/// Pitch in waiting [deg] of a whole mission; NaN where it never came to wait.
/// @param wait  a scenario: kMetalMission, kConcreteMission
[[nodiscard]] double flown_swing_deg(const char* wait, const CausePoint& point, std::uint32_t run);
inline constexpr const char* kMetalMission = "perch_metal";
inline constexpr const char* kConcreteMission = "perch_concrete";

/// What the paper states of the swing, or what a synthetic vehicle shows.
struct SwingStatement {
    double metal_from_deg = 5.0;     ///< "exceeding 5 deg. after 16 s"
    double metal_to_deg = 10.0;      ///< assumed: "interrupted to avoid any incident", not beyond
    double concrete_from_deg = 0.5;  ///< "oscillates", in a plot of +-10 deg (assumed)
    double concrete_to_deg = 5.0;
    double simulated_to_deg = 1.0;  ///< "remains stable"
};
inline constexpr double kMetalWait_s = 16.0;
inline constexpr double kConcreteWait_s = 1.0;

/// The paper's simulation of a point: the same arm, gains and joint, Gazebo's motors in still air,
/// and of the dead time what the autopilot brings with it.
[[nodiscard]] CausePoint simulated(CausePoint point);

/// A draw of the prior, and what the linearised loop makes of it and of the paper's simulation.
struct CauseDraw {
    CausePoint point;
    PointSwing swing;
    PointSwing simulated;
};
/// Of each set of causes as many, by the bits of the causes that take part.
using PriorDraws = std::vector<std::vector<CauseDraw>>;
/// @param draws  of each set
[[nodiscard]] PriorDraws draw_prior(std::size_t draws, std::uint64_t seed, int jobs,
                                    const std::function<void()>& between = {});

/// The prior's draws, weighed by the paper's statements; refers to them.
struct CausePosterior {
    const PriorDraws* draws = nullptr;
    std::vector<study::Weighted> weighted;  ///< one a set
    /// Of the sets, all alike before.
    [[nodiscard]] std::vector<double> set_probabilities() const;
    /// That a cause takes part.
    [[nodiscard]] double probability(Cause cause) const;
    /// Quantile over sets and draws of the value `of` a draw.
    [[nodiscard]] double quantile(const std::function<double(const CauseDraw&)>& of,
                                  double share) const;
};
/// By the closed form.
[[nodiscard]] CausePosterior weigh(const PriorDraws& draws, const SwingSize& size,
                                   const SwingStatement& stated);

/// Whether whole missions of a draw show what is stated: on metal, on concrete, and in its
/// simulation. One that gives no figure does not.
[[nodiscard]] bool explains(const CausePoint& point, const SwingStatement& stated,
                            std::uint32_t run);

/// The posterior by flights, which knows nothing of the closed form but which draws to fly.
struct FlownCauses {
    /// Of those that explain what is stated 1 / (chance of having been chosen), else 0: the mean of
    /// a set's weights is its evidence, whatever the chances were.
    CausePosterior posterior;
    std::vector<double> evidence_errors;         ///< standard errors, one a set
    std::vector<statistics::Proportion> shares;  ///< one a set: of those flown, how many explain it
    std::size_t flown = 0;                       ///< draws
    std::size_t explaining = 0;                  ///< of them
    /// 95 % of posterior.probability(), by the effective number of the draws that explain it.
    [[nodiscard]] statistics::Interval probability_interval(Cause cause) const;
};
/// Flies draws of the prior, those more probably that the closed form takes for likely.
/// @param closed  weigh()'s
/// @param draws   so many, of all sets together
[[nodiscard]] FlownCauses fly_chosen(const CausePosterior& closed, const SwingStatement& stated,
                                     std::size_t draws, std::uint64_t seed, int jobs,
                                     const std::function<void()>& between = {});
/// The share of a set's first draws that explain what is stated, each flown: no closed form at all.
[[nodiscard]] statistics::Proportion fly_plainly(const std::vector<CauseDraw>& set,
                                                 std::size_t draws, const SwingStatement& stated,
                                                 int jobs);
/// The closed form's weights with a factor for each cause, so that its causes are as probable as
/// flown: for what so few flights cannot tell, within sets.
[[nodiscard]] CausePosterior agreeing(const CausePosterior& closed, const CausePosterior& flown);

/// A measurement that nobody has published, and how many bits it would give on which causes take
/// part.
struct CauseMeasurement {
    std::string name;
    std::string accuracy;
    double bits = 0.0;
};
/// Best first. Draws that explain next to nothing of the statements are left out.
[[nodiscard]] std::vector<CauseMeasurement> measurements(const CausePosterior& posterior,
                                                         std::uint64_t seed, int jobs);

}  // namespace limpet::causes
