// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/px4_crew.hpp"

#include <fmt/format.h>

#include <new>
#include <thread>
#include <vector>

#include "limpet/campaign/ledger.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/px4/process.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "limpet/simulation/px4_setup.hpp"

namespace limpet::campaign {
namespace {

constexpr int kTries = 2;

/// One PX4 of the crew, anew for each flight.
class Seat {
public:
    Seat(const Campaign& campaign, const Px4Crew& crew, int number, const std::atomic<bool>* stop)
        : campaign_(campaign), crew_(crew), instance_{crew.first.number + number}, stop_(stop) {}

    /// @throws InputError when no PX4 is to be had
    /// @throws Interrupted on stop
    void fly(RunRow& row) const {
        const auto model = model_of(campaign_, row);
        for (int left = kTries; left > 0; --left) {
            std::optional<px4::Px4Process> process;
            const px4::Px4Airframe airframe = simulation::px4_airframe(*model->scenario);
            if (crew_.start) {
                process.emplace(*crew_.start, airframe, instance_);
            }
            px4::Px4Addresses addresses = simulation::px4_addresses(*model->scenario, instance_);
            addresses.expected = px4::expected_parameters(
                airframe, process ? process->left_out() : std::vector<std::string>());
            addresses.wait_s = crew_.wait_s;
            addresses.only_px4 = crew_.only_px4;
            px4::Px4WireWatch watch{.wait_key = "--wait SECONDS"};
            watch.on_wait = [&process](double) {
                if (process) {
                    process->require_running();
                }
            };
            std::string differs;
            watch.on_difference = [&differs](const auto& found) {
                differs = fmt::format("; {} parameters differ: {}", found.size(),
                                      mavlink::text_of(found.front()));
            };
            px4::Px4Wires wires(addresses, model->control_rate_Hz, true, watch, stop_);
            const bool began = try_to_fly(row, model, wires);
            row.autopilot += differs;
            if (began) {
                return;
            }
        }
    }

private:
    /// @return false when it did not begin; the row then says why
    bool try_to_fly(RunRow& row, const std::shared_ptr<const simulation::FlightModel>& model,
                    px4::Px4Wires& wires) const {
        simulation::FlightConduct conduct{.stop = stop_};
        conduct.outside.autopilot = &wires.autopilot();
        bool began = true;
        try {
            fill(row, simulation::fly(model, {}, {}, row.run, conduct));
        } catch (const InputError& error) {
            row.outcome = kNoFlight;
            row.reason = error.what();
            began = false;
        } catch (const InternalError& error) {
            row.outcome = kFault;
            row.reason = error.what();
        }
        const auto who = wires.autopilot().identity();
        row.autopilot = who ? simulation::who_text(*who) : "";
        return began;
    }

    const Campaign& campaign_;
    const Px4Crew& crew_;
    const px4::Px4Instance instance_;
    const std::atomic<bool>* stop_;
};

void take_seat(const Results& results, const Px4Crew& crew, int number, Ledger& ledger,
               const CampaignWatch& watch) noexcept {
    try {
        const Seat seat(results.campaign(), crew, number, watch.stop);
        while (auto next = ledger.next()) {
            seat.fly(next->row);
            if (watch.stop != nullptr && *watch.stop) {
                return;
            }
            ledger.land(next->row);
        }
    } catch (const Interrupted&) {  // the ledger knows how far the campaign has come
    } catch (...) {
        ledger.fail(std::current_exception());
    }
}

}  // namespace

void Px4Crew::check() const {
    const int last = first.number + instances - 1;
    if (last > px4::Px4Instance::kMost) {
        throw InputError(
            fmt::format("--instance {} and {} of them: the last would be {}, at most "
                        "{} have separate ports",
                        first.number, instances, last, px4::Px4Instance::kMost));
    }
}

Progress run_campaign_on_px4(Results& results, const Px4Crew& crew, const CampaignWatch& watch) {
    require(results.campaign().on_px4, "rows have a place for who flew them");
    crew.check();
    Ledger ledger(results, watch);
    {
        std::vector<std::jthread> seats;
        for (int number = 0; number < crew.instances; ++number) {
            try {
                seats.emplace_back(
                    [&, number] { take_seat(results, crew, number, ledger, watch); });
            } catch (...) {  // no thread, no memory: without it nothing is right
                ledger.fail(std::current_exception());
            }
        }
    }
    return ledger.conclude();
}

}  // namespace limpet::campaign
