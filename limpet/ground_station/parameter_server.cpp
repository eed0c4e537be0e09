// SPDX-License-Identifier: Apache-2.0
#include "limpet/ground_station/parameter_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/mavlink/parameter_value.hpp"

namespace limpet::ground_station {
using namespace mavlink;
namespace {

constexpr std::size_t kLongestName = 16;

std::uint8_t type_of(const ServedParameter& parameter) {
    return parameter.int32 ? MavParamType::int32 : MavParamType::real32;
}

}  // namespace

ParameterServer::ParameterServer(std::vector<ServedParameter> parameters, Set set, Refused refused)
    : parameters_(std::move(parameters)),
      set_(std::move(set)),
      refused_(std::move(refused)),
      next_(parameters_.size()) {
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
        const std::string& name = parameters_[i].name;
        require(!name.empty() && name.size() <= kLongestName, "a parameter's name fits the wire");
        require(find(name) == i, "a parameter's name stands once");
    }
}

std::size_t ParameterServer::find(std::string_view name) const {
    const auto at = std::find_if(parameters_.begin(), parameters_.end(),
                                 [name](const ServedParameter& each) { return each.name == name; });
    return static_cast<std::size_t>(at - parameters_.begin());
}

void ParameterServer::answer(std::size_t index, Link& link) const {
    if (index >= parameters_.size()) {
        return;  // the protocol has no answer for what is not there
    }
    ParamValue message{
        .param_value = parameter_on_wire(parameters_[index].value, parameters_[index].int32),
        .param_type = type_of(parameters_[index]),
        .param_count = static_cast<std::uint16_t>(parameters_.size()),
        .param_index = static_cast<std::uint16_t>(index)};
    set_text(message.param_id, parameters_[index].name);
    (void)link.send(message, kAtOnce);
}

void ParameterServer::set(const ParamSet& message, Link& link) {
    const std::size_t index = find(text_of(message.param_id));
    if (index >= parameters_.size()) {
        return;
    }
    ServedParameter& parameter = parameters_[index];
    const double wanted = parameter_value(message);
    std::array<char, 160> text = {};
    const auto refuse = [&](auto format, const auto&... values) {
        const auto end = fmt::format_to_n(text.data(), text.size(), format, values...).out;
        refused_({text.data(), static_cast<std::size_t>(end - text.data())});
    };
    if (message.param_type != type_of(parameter)) {
        refuse(FMT_STRING("{} refused: type {}, must be {}"), parameter.name, message.param_type,
               parameter.int32 ? "6 (INT32)" : "9 (REAL32)");
    } else if (!(wanted >= static_cast<float>(parameter.minimum) &&
                 wanted <= static_cast<float>(parameter.maximum))) {  // nor what is no number
        refuse(FMT_STRING("{} = {:g} refused, allowed {:g} .. {:g}"), parameter.name, wanted,
               parameter.minimum, parameter.maximum);
    } else if (parameter.whole && wanted != std::round(wanted)) {
        refuse(FMT_STRING("{} = {:g} refused, must be whole"), parameter.name, wanted);
    } else if (wanted != static_cast<float>(parameter.value)) {
        // The limits themselves have more digits than the wire.
        parameter.value = std::clamp(wanted, parameter.minimum, parameter.maximum);
        set_(parameter.name, parameter.value);
    }
    answer(index, link);
}

bool ParameterServer::handle(const Frame& frame, Link& link) {
    const auto ours = [&](const auto& message) {
        return message && addressed_to(link.self(), *message);
    };
    const auto list = decode<ParamRequestList>(frame);
    const auto read = decode<ParamRequestRead>(frame);
    const auto wanted = decode<ParamSet>(frame);
    if (ours(list)) {
        next_ = 0;
    } else if (ours(read)) {
        answer(read->param_index >= 0 ? static_cast<std::size_t>(read->param_index)
                                      : find(text_of(read->param_id)),
               link);
    } else if (ours(wanted)) {
        set(*wanted, link);
    }
    return list || read || wanted;
}

void ParameterServer::update(Link& link) {
    const std::size_t end = std::min(parameters_.size(), next_ + kPerUpdate);
    for (; next_ < end; ++next_) {
        answer(next_, link);
    }
}

}  // namespace limpet::ground_station
