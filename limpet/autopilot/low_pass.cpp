// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/low_pass.hpp"

#include <cmath>

namespace limpet::autopilot {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;
/// Closer to half the sample rate than this the bilinear transform is of no use.
constexpr double kLargestCutoff = 0.45;

void tune(LowPass& filter, double cutoff_Hz, double interval_s) {
    filter.cutoff_Hz = cutoff_Hz;
    filter.interval_s = interval_s;
    const double warped = std::tan(kPi * cutoff_Hz * interval_s);
    const double c = 1.0 + kSqrt2 * warped + warped * warped;
    filter.b0 = warped * warped / c;
    filter.a1 = 2.0 * (warped * warped - 1.0) / c;
    filter.a2 = (1.0 - kSqrt2 * warped + warped * warped) / c;
}

}  // namespace

void reset(LowPass& filter, const Vector3& value) {
    filter.input_1 = filter.input_2 = value;
    filter.output_1 = filter.output_2 = value;
}

Vector3 low_pass(LowPass& filter, const Vector3& input, double cutoff_Hz, double interval_s) {
    if (cutoff_Hz <= 0.0 || cutoff_Hz * interval_s > kLargestCutoff) {
        reset(filter, input);
        return input;
    }
    if (filter.cutoff_Hz != cutoff_Hz || std::abs(filter.interval_s - interval_s) > 1e-9) {
        tune(filter, cutoff_Hz, interval_s);
    }
    Vector3 output = filter.b0 * (input + 2.0 * filter.input_1 + filter.input_2) -
                     filter.a1 * filter.output_1 - filter.a2 * filter.output_2;
    filter.input_2 = filter.input_1;
    filter.input_1 = input;
    filter.output_2 = filter.output_1;
    filter.output_1 = output;
    return output;
}

Vector3 low_pass_1(LowPass& filter, const Vector3& input, double cutoff_Hz, double interval_s) {
    if (cutoff_Hz <= 0.0) {
        reset(filter, input);
        return input;
    }
    const double share = interval_s / (interval_s + 1.0 / (2.0 * kPi * cutoff_Hz));
    filter.output_1 += share * (input - filter.output_1);
    return filter.output_1;
}

}  // namespace limpet::autopilot
