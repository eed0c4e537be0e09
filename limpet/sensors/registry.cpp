// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/registry.hpp"

namespace limpet::sensors {
namespace {

template <class... All>
constexpr bool streams_apart(TypeList<All...> /*list*/) {
    std::array<int, 100> draw{};
    bool apart = true;
    for_each_type(TypeList<All...>{}, [&](auto sensor) {
        for (const Stream stream : decltype(sensor)::type::kStreams) {
            const auto number = static_cast<std::size_t>(stream);
            apart = apart && number >= 10 && number < 30 && draw[number]++ == 0;
        }
    });
    return apart;
}
static_assert(streams_apart(Sensors{}), "sensors draw from streams 10..29, no two from one");

}  // namespace

std::vector<BoundParameter> sensor_rows(SensorParameters& sensors) {
    return bind_all(Sensors{}, sensors);
}

std::vector<int> rates_Hz(const SensorParameters& sensors) {
    std::vector<int> rates;
    for_each_type(Sensors{},
                  [&](auto sensor) { rates.push_back(sensors.*decltype(sensor)::type::kRate_Hz); });
    return rates;
}

}  // namespace limpet::sensors
