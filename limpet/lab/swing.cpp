// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/swing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::lab {
namespace {

using nlohmann::json;

constexpr std::uint32_t kLeastCount = 2, kMostCount = 64;

stability::Axis axis_in(const json& request, const char* name) {
    try {
        const json& asked = request.at(name);
        const double from = asked.at("from"), to = asked.at("to");
        const std::uint32_t count = whole_in(asked, "count", kLeastCount, kMostCount);
        stability::Axis axis{.keys = asked.at("keys")};
        if (axis.keys.empty() || !(from < to)) {
            throw InputError(fmt::format("\"{}\": at least a key, \"from\" below \"to\"", name));
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            axis.values.push_back(from + (to - from) * static_cast<double>(k) /
                                             static_cast<double>(count - 1));
        }
        return axis;
    } catch (const json::exception&) {
        throw InputError(fmt::format(
            "\"{}\" is {{\"keys\": [texts], \"from\", \"to\", \"count\"}}, numbers", name));
    }
}

bool is_on(const stability::Axis& axis, std::string_view change) {
    const std::string_view key = change.substr(0, change.find('='));
    return std::find(axis.keys.begin(), axis.keys.end(), key) != axis.keys.end();
}

std::vector<double> numbers_of(scenario::Scenario& scenario, const stability::Axis& axis) {
    std::vector<double> values;
    for (const std::string& key : axis.keys) {
        for (const scenario::Section& section : scenario_sections(scenario)) {
            for (const BoundParameter& row : section.rows) {
                if (key == section.name + "." + std::string(row.name)) {
                    values.push_back(row.value.get());
                }
            }
        }
    }
    if (values.size() != axis.keys.size()) {
        throw InputError(
            fmt::format("\"keys\": {} is no number of the scenario", fmt::join(axis.keys, " or ")));
    }
    return values;
}

std::vector<std::size_t> coarse_first(std::size_t across, std::size_t up) {
    std::vector<std::size_t> order;
    std::vector<bool> taken(across * up);
    for (const std::size_t stride : {4U, 2U, 1U}) {
        for (std::size_t j = 0; j < up; j += stride) {
            for (std::size_t i = 0; i < across; i += stride) {
                if (!taken[j * across + i]) {
                    taken[j * across + i] = true;
                    order.push_back(j * across + i);
                }
            }
        }
    }
    return order;
}

bool same(const stability::Axis& a, const stability::Axis& b) {
    return a.keys == b.keys && a.values == b.values;
}

}  // namespace

Swing::~Swing() {
    stop();
}

void Swing::begin(std::string_view request) {
    const json asked = object_in(request);
    FlightRequest wish = flight_request_in(asked, first_);
    stability::StabilityMap map{
        .scenario = wish.scenario, .across = axis_in(asked, "across"), .up = axis_in(asked, "up")};
    std::copy_if(
        wish.changes.begin(), wish.changes.end(), std::back_inserter(map.changes),
        [&](const std::string& text) { return !is_on(map.across, text) && !is_on(map.up, text); });
    scenario::Scenario scenario =
        scenario::load_scenario(wish.scenario, {.overrides = wish.changes});
    std::vector<double> across = numbers_of(scenario, map.across);
    std::vector<double> up = numbers_of(scenario, map.up);
    own_ = {true, swing_of_(wish.scenario, wish.changes)};
    own_across_ = std::move(across);
    own_up_ = std::move(up);
    if (id_ > 0 && !stop_ && map.scenario == map_.scenario && map.changes == map_.changes &&
        same(map.across, map_.across) && same(map.up, map_.up)) {
        return;
    }
    stop();
    threads_.clear();
    map_ = std::move(map);
    order_ = coarse_first(map_.across.values.size(), map_.up.values.size());
    points_.assign(map_.size(), {});
    next_ = 0;
    trouble_.clear();
    stop_ = false;
    ++id_;
    // One processor is the page's.
    const int most = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
    for (int k = 0; k < most; ++k) {
        ++working_;
        try {
            threads_.emplace_back([this] {
                fill();
                --working_;
            });
        } catch (const std::exception&) {  // no thread can be had: those that there are do it
            --working_;
            if (k == 0) {
                throw;
            }
        }
    }
}

void Swing::fill() {
    for (std::size_t k = next_++; k < order_.size() && !stop_; k = next_++) {
        Point point{true};
        try {
            point.mode = swing_of_(map_.scenario, map_.point(order_[k]));
        } catch (const InputError&) {  // these two do not go together
        } catch (const std::exception&) {
            trouble_.keep();
            stop_ = true;
            return;
        }
        const std::lock_guard lock(guards_points_);
        points_[order_[k]] = point;
    }
}

std::string Swing::state() {
    trouble_.say();
    const bool running = working_ > 0;  // before the points: none is missed when it has ended
    const std::lock_guard lock(guards_points_);
    const auto axis_json = [](const stability::Axis& axis, const std::vector<double>& own) {
        return json{{"keys", axis.keys}, {"values", axis.values}, {"own", own}};
    };
    json growth = json::array();
    for (const Point& point : points_) {
        growth.push_back(!point.done   ? json()
                         : !point.mode ? json("none")
                                       : json(point.mode->growth_1_s));
    }
    return json{{"id", id_},
                {"running", running},
                {"done", std::count_if(points_.begin(), points_.end(),
                                       [](const Point& point) { return point.done; })},
                {"across", axis_json(map_.across, own_across_)},
                {"up", axis_json(map_.up, own_up_)},
                {"growth_1_s", growth},
                {"own",
                 {{"growth_1_s", own_.mode ? json(own_.mode->growth_1_s) : json()},
                  {"frequency_Hz", own_.mode ? json(own_.mode->frequency_Hz) : json()}}}}
        .dump();
}

}  // namespace limpet::lab
