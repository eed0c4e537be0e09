// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "limpet/core/lanes.hpp"

namespace limpet {

/// A number and its slopes along so many directions: a model written on a scalar type T tells with
/// it how all that it finds depends on what is put in, exact to rounding. Its value is that of the
/// model on Lanes<1>, bit for bit; what depends on a comparison has the slopes of the side that is
/// taken.
template <int kDirections>
struct Dual {
    using Mask = bool;
    static constexpr int kCount = 1;
    double v;
    std::array<double, static_cast<std::size_t>(kDirections)> slopes;

    Dual() = default;
    Dual(double value) : v(value), slopes{} {}  // NOLINT(*-explicit-*)
    /// What the slopes are along direction `at`.
    [[nodiscard]] static Dual along(double value, int at) {
        Dual dual(value);
        dual.slopes[static_cast<std::size_t>(at)] = 1.0;
        return dual;
    }
    explicit operator double() const { return v; }
    // As a lane by itself.
    [[nodiscard]] double operator[](int /*lane*/) const { return v; }
    void set(int /*lane*/, double value) { *this = value; }

    /// f(a, b), of which the slopes by a and b are known.
    [[nodiscard]] static Dual of(double value, double by_a, const Dual& a, double by_b,
                                 const Dual& b) {
        Dual result(value);
        for (std::size_t k = 0; k < result.slopes.size(); ++k) {
            result.slopes[k] = by_a * a.slopes[k] + by_b * b.slopes[k];
        }
        return result;
    }
    [[nodiscard]] static Dual of(double value, double by_a, const Dual& a) {
        return of(value, by_a, a, 0.0, a);
    }
    friend Dual operator+(const Dual& a, const Dual& b) { return of(a.v + b.v, 1.0, a, 1.0, b); }
    friend Dual operator-(const Dual& a, const Dual& b) { return of(a.v - b.v, 1.0, a, -1.0, b); }
    friend Dual operator*(const Dual& a, const Dual& b) { return of(a.v * b.v, b.v, a, a.v, b); }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const double value = a.v / b.v;
        return of(value, 1.0 / b.v, a, -value / b.v, b);
    }
    friend Dual operator-(const Dual& a) { return of(-a.v, -1.0, a); }
    Dual& operator+=(const Dual& b) { return *this = *this + b; }
    Dual& operator-=(const Dual& b) { return *this = *this - b; }
    Dual& operator*=(const Dual& b) { return *this = *this * b; }
    Dual& operator/=(const Dual& b) { return *this = *this / b; }
    friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
    friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
    friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
    friend bool operator>=(const Dual& a, const Dual& b) { return a.v >= b.v; }
    friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }
    friend bool operator!=(const Dual& a, const Dual& b) { return a.v != b.v; }
    friend Dual select(bool which, const Dual& yes, const Dual& no) { return which ? yes : no; }
    friend Dual sqrt(const Dual& a) {
        const double root = std::sqrt(a.v);
        return of(root, 0.5 / root, a);
    }
};

template <class T>
inline constexpr bool kIsDual = false;
template <int kDirections>
inline constexpr bool kIsDual<Dual<kDirections>> = true;

/// As of lanes, whose reduction to a quarter of a turn has no slope.
template <class T>
requires kIsDual<T>
inline void sine_cosine(const T& angle_rad, T& sine, T& cosine) {
    Lanes<1> s, c;
    sine_cosine<Lanes<1>>(angle_rad.v, s, c);
    sine = T::of(s.v, c.v, angle_rad);
    cosine = T::of(c.v, -s.v, angle_rad);
}

}  // namespace limpet

template <int kDirections>
struct Eigen::NumTraits<limpet::Dual<kDirections>> : Eigen::NumTraits<double> {
    using Real = limpet::Dual<kDirections>;
    using NonInteger = Real;
    using Nested = Real;
    using Literal = double;
    enum {
        RequireInitialization = 0
    };
};
template <int kDirections, class Op>
struct Eigen::ScalarBinaryOpTraits<double, limpet::Dual<kDirections>, Op> {
    using ReturnType = limpet::Dual<kDirections>;
};
template <int kDirections, class Op>
struct Eigen::ScalarBinaryOpTraits<limpet::Dual<kDirections>, double, Op> {
    using ReturnType = limpet::Dual<kDirections>;
};
