// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/fliers.hpp"

#include <new>
#include <system_error>

#include "limpet/plant/lane_group.hpp"

namespace limpet::campaign {
namespace {

void fly_lane(const Campaign& campaign, RunSource& source, const std::atomic<bool>* stop) noexcept {
    try {
        while (auto next = source.next()) {
            fly_row(campaign, next->row, next->noise, stop);
            if (stop != nullptr && *stop) {
                return;
            }
            source.land(next->row);
        }
    } catch (...) {
        source.fail(std::current_exception());
    }
}

void fly_lanes(const Campaign& campaign, RunSource& source,
               const std::atomic<bool>* stop) noexcept {
    try {
        plant::fly_side_by_side([&] { fly_lane(campaign, source, stop); });
    } catch (...) {
        source.fail(std::current_exception());
    }
}

}  // namespace

Fliers::Fliers(int jobs, const Campaign& campaign, RunSource& source,
               const std::atomic<bool>* stop) {
    try {
        while (threads_.size() < static_cast<std::size_t>(jobs)) {
            ++flying_;
            threads_.emplace_back([this, &campaign, &source, stop] {
                fly_lanes(campaign, source, stop);
                --flying_;
            });
        }
    } catch (const std::system_error&) {  // no more threads to be had: those there are will do
        --flying_;
    } catch (const std::bad_alloc&) {  // nor memory for them
        --flying_;
    }
}

void fly_all(int jobs, const Campaign& campaign, RunSource& source,
             const std::atomic<bool>* break_off) {
    const Fliers others(jobs - 1, campaign, source, break_off);
    fly_lanes(campaign, source, break_off);
}

}  // namespace limpet::campaign
