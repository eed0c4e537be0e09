// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/px4/process.hpp"
#include "limpet/px4/wires.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/wire_log.hpp"
#include "terminal.hpp"

namespace limpet::app {

/// Options of the verbs that fly a PX4.
struct Px4LinkOptions {
    px4::Px4Instance instance;
    std::optional<std::string> start;     ///< of Px4Process; none: it is started elsewhere
    std::optional<std::string> hil;       ///< none: the instance's
    std::optional<std::string> offboard;  ///< likewise
    double wait_s = 60.0;
    double patience_s = 5.0;
    bool record_wire = false;
    bool only_px4 = false;
    std::string speed;  ///< "" as suits the wire, "max", or a factor

    [[nodiscard]] bool serial() const { return hil && hil->starts_with("serial:"); }
};
/// Before any work, and whether or not a wire is there.
/// @throws InputError naming the option that cannot be, alone or with the others
void check(const Px4LinkOptions& options, const scenario::Scenario& scenario);
/// @param flies  guidance is ours; false: a companion's
[[nodiscard]] OptionList options_of(Px4LinkOptions& options, bool flies);
/// --px4, of the verbs that start one themselves.
[[nodiscard]] Option px4_start_option(std::optional<std::string>& start);

/// @return times real time, 0 as fast as it goes
/// @param by_default  when --speed is not given
/// @throws InputError for anything but "max" or a positive number
[[nodiscard]] double speed_of(const std::string& text, double by_default);

/// A PX4 on its wires.
class Px4Link {
public:
    /// Opens the wires and waits for a PX4 on them; prints what it waits for and how to start it.
    /// @param options  checked
    /// @param flies  guidance is ours; false: a companion's
    /// @param folder  where options.record_wire writes wire.mcap
    /// @throws InputError when a wire cannot be opened or no PX4 comes in time; nothing is then
    ///         left in the folder but the console of a PX4 that was started
    /// @throws Interrupted on `stop`
    Px4Link(const Px4LinkOptions& options, const simulation::FlightModel& model, bool flies,
            const std::filesystem::path& folder, Terminal& terminal, const std::atomic<bool>* stop);

    /// Closes wire.mcap, and keeps the logs of a PX4 that was started, when no flight came of it.
    ~Px4Link();
    Px4Link(const Px4Link&) = delete;
    Px4Link& operator=(const Px4Link&) = delete;

    [[nodiscard]] px4::Px4Autopilot& autopilot() { return wires_->autopilot(); }
    [[nodiscard]] double speed() const { return speed_; }

    /// After the flight, for people: messages, misses, latency; whose time it was.
    void report(const simulation::FlightPerformance& performance, Terminal& terminal) const;
    /// The same for programs, with the histograms: link.json; next to the recording, which
    /// must not depend on wall time. Closes wire.mcap.
    /// With it the logs of a PX4 that was started, which ends here: px4.log, px4.ulg; the errors,
    /// warnings and failsafes of its console are printed.
    /// @param figures  draws the histograms too, as link.png and link.svg
    /// @return what was written
    /// @throws InputError when it cannot
    [[nodiscard]] std::vector<std::filesystem::path> write(
        const simulation::FlightPerformance& performance, const std::filesystem::path& folder,
        bool figures, Terminal& terminal);

private:
    /// Those that there are, named.
    [[nodiscard]] std::vector<std::pair<const char*, const mavlink::Link*>> links() const;

    /// @return what was kept next to the recording; nothing of a PX4 that others have started
    std::vector<std::filesystem::path> keep_logs(const std::filesystem::path& folder);

    std::optional<px4::Px4Process> process_;
    std::filesystem::path folder_;  ///< next to the recording; empty: there is none
    bool kept_ = false;
    std::vector<std::string> differences_;  ///< of parameters, for people
    std::unique_ptr<simulation::WireLog> wire_log_;
    std::optional<px4::Px4Wires> wires_;
    double speed_ = 0.0;  ///< times real time; 0: as fast as possible
    bool wire_finished_ = false;
};

}  // namespace limpet::app
