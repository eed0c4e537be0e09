// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

// A scalar type of several numbers side by side, one a lane: a model written on a scalar type T
// does with it for many missions what it does with double for one, bit for bit. Whatever depends on
// a comparison is a select(); where a rare case is dear, `if (any(mask))` around it.
namespace limpet {

/// The compiler's vectors. Aligned as Eigen aligns on every machine: wide loads need no more.
template <class Number, int kWidth>
struct VectorOf {
    typedef Number Type  // NOLINT(modernize-use-using): takes no such attribute
        __attribute__((vector_size(sizeof(Number) * kWidth), aligned(16)));
};

/// Which lanes.
template <int kWidth>
struct LaneMask {
    using Vector = typename VectorOf<long long, kWidth>::Type;
    Vector v{};  ///< -1 yes, 0 no

    [[nodiscard]] bool operator[](int lane) const { return v[lane] != 0; }
    void set(int lane, bool yes) { v[lane] = yes ? -1 : 0; }
    [[gnu::always_inline]] friend LaneMask operator&&(LaneMask a, LaneMask b) {
        return {a.v & b.v};
    }
    [[gnu::always_inline]] friend LaneMask operator||(LaneMask a, LaneMask b) {
        return {a.v | b.v};
    }
    [[gnu::always_inline]] friend LaneMask operator!(LaneMask a) { return {~a.v}; }
};

template <int kWidth>
struct Lanes {
    using Vector = typename VectorOf<double, kWidth>::Type;
    using Mask = LaneMask<kWidth>;
    static constexpr int kCount = kWidth;
    Vector v;

    Lanes() = default;
    /// The same in every lane.
    [[gnu::always_inline]] Lanes(double all) : v(all - Vector{}) {}  // NOLINT(*-explicit-*)
    [[gnu::always_inline]] explicit Lanes(Vector each) : v(each) {}

    [[nodiscard]] double operator[](int lane) const { return v[lane]; }
    void set(int lane, double value) { v[lane] = value; }

    [[gnu::always_inline]] friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
    [[gnu::always_inline]] friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
    [[gnu::always_inline]] friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
    [[gnu::always_inline]] friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
    [[gnu::always_inline]] friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
    [[gnu::always_inline]] Lanes& operator+=(Lanes b) { return *this = *this + b; }
    [[gnu::always_inline]] Lanes& operator-=(Lanes b) { return *this = *this - b; }
    [[gnu::always_inline]] Lanes& operator*=(Lanes b) { return *this = *this * b; }
    [[gnu::always_inline]] Lanes& operator/=(Lanes b) { return *this = *this / b; }
    [[gnu::always_inline]] friend Mask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
    [[gnu::always_inline]] friend Mask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
    [[gnu::always_inline]] friend Mask operator<=(Lanes a, Lanes b) { return {a.v <= b.v}; }
    [[gnu::always_inline]] friend Mask operator>=(Lanes a, Lanes b) { return {a.v >= b.v}; }
    [[gnu::always_inline]] friend Mask operator==(Lanes a, Lanes b) { return {a.v == b.v}; }
    [[gnu::always_inline]] friend Mask operator!=(Lanes a, Lanes b) { return {a.v != b.v}; }
    [[gnu::always_inline]] friend Lanes select(Mask which, Lanes yes, Lanes no) {
        return Lanes(which.v ? yes.v : no.v);
    }
    [[gnu::always_inline]] friend Lanes sqrt(Lanes a) {
        for (int lane = 0; lane < kWidth; ++lane) {
            a.v[lane] = std::sqrt(a.v[lane]);
        }
        return a;
    }
};

template <int kWidth>
[[gnu::always_inline]] inline bool any(LaneMask<kWidth> mask) {
    long long sum = 0;
    for (int lane = 0; lane < kWidth; ++lane) {
        sum |= mask.v[lane];
    }
    return sum != 0;
}
template <int kWidth>
[[gnu::always_inline]] inline bool all(LaneMask<kWidth> mask) {
    return !any(!mask);
}

/// Where a lane is one of several, or the only one.
template <>
struct Lanes<1> {
    using Mask = bool;
    static constexpr int kCount = 1;
    double v;

    Lanes() = default;
    [[gnu::always_inline]] Lanes(double value) : v(value) {}  // NOLINT(*-explicit-*)
    [[gnu::always_inline]] explicit operator double() const { return v; }
    [[nodiscard]] double operator[](int /*lane*/) const { return v; }
    void set(int /*lane*/, double value) { v = value; }

    [[gnu::always_inline]] friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
    [[gnu::always_inline]] friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
    [[gnu::always_inline]] friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
    [[gnu::always_inline]] friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
    [[gnu::always_inline]] friend Lanes operator-(Lanes a) { return -a.v; }
    [[gnu::always_inline]] Lanes& operator+=(Lanes b) { return *this = *this + b; }
    [[gnu::always_inline]] Lanes& operator-=(Lanes b) { return *this = *this - b; }
    [[gnu::always_inline]] Lanes& operator*=(Lanes b) { return *this = *this * b; }
    [[gnu::always_inline]] Lanes& operator/=(Lanes b) { return *this = *this / b; }
    [[gnu::always_inline]] friend bool operator<(Lanes a, Lanes b) { return a.v < b.v; }
    [[gnu::always_inline]] friend bool operator>(Lanes a, Lanes b) { return a.v > b.v; }
    [[gnu::always_inline]] friend bool operator<=(Lanes a, Lanes b) { return a.v <= b.v; }
    [[gnu::always_inline]] friend bool operator>=(Lanes a, Lanes b) { return a.v >= b.v; }
    [[gnu::always_inline]] friend bool operator==(Lanes a, Lanes b) { return a.v == b.v; }
    [[gnu::always_inline]] friend bool operator!=(Lanes a, Lanes b) { return a.v != b.v; }
    [[gnu::always_inline]] friend Lanes select(bool which, Lanes yes, Lanes no) {
        return which ? yes : no;
    }
    [[gnu::always_inline]] friend Lanes sqrt(Lanes a) { return std::sqrt(a.v); }
};

/// A single number is a lane by itself.
[[gnu::always_inline]] inline double select(bool which, double yes, double no) {
    return which ? yes : no;
}
[[gnu::always_inline]] inline bool any(bool mask) {
    return mask;
}
[[gnu::always_inline]] inline bool all(bool mask) {
    return mask;
}

template <class T>
struct MaskOfScalar {
    using Type = typename T::Mask;
};
template <>
struct MaskOfScalar<double> {
    using Type = bool;
};
template <class T>
using MaskOf = typename MaskOfScalar<T>::Type;

[[nodiscard]] inline bool in_lane(bool mask, int /*lane*/) {
    return mask;
}
template <int kWidth>
[[nodiscard]] bool in_lane(LaneMask<kWidth> mask, int lane) {
    return mask[lane];
}
inline void set_lane(bool& mask, int /*lane*/, bool yes) {
    mask = yes;
}
template <int kWidth>
void set_lane(LaneMask<kWidth>& mask, int lane, bool yes) {
    mask.set(lane, yes);
}

/// Of an angle below 0.1 rad, to the last bits: its cosine, and its sine over it.
/// @param x  the angle's square
template <class T>
[[gnu::always_inline]] inline void small_sine_cosine(const T& x, T& sine_over, T& cosine) {
    sine_over =
        1.0 - x * (1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0 - x * (1.0 / 362880.0))));
    cosine =
        1.0 -
        x * (1.0 / 2.0 -
             x * (1.0 / 24.0 - x * (1.0 / 720.0 - x * (1.0 / 40320.0 - x * (1.0 / 3628800.0)))));
}

/// Sine and cosine of an angle, the same bits at every width: Cody and Waite's reduction by pi/2 in
/// two parts, Taylor's series on an eighth of a turn either way. Error below 2 in the last place up
/// to some 1e5 rad.
template <class T>
[[gnu::always_inline]] inline void sine_cosine(const T& angle_rad, T& sine, T& cosine) {
    constexpr double kRound = 6755399441055744.0;  // 1.5 2^52: adding it rounds to whole numbers
    constexpr double kHigh = 1.5707963267341256, kLow = 6.077100506506192e-11;
    const T quarters = (angle_rad * 0.6366197723675814 + kRound) - kRound;
    const T x = (angle_rad - quarters * kHigh) - quarters * kLow;
    const T z = x * x;
    const T s = x + x * z *
                        (-1.6666666666666666e-01 +
                         z * (8.3333333333333332e-03 +
                              z * (-1.9841269841269841e-04 +
                                   z * (2.7557319223985893e-06 +
                                        z * (-2.5052108385441720e-08 +
                                             z * (1.6059043836821613e-10 -
                                                  z * (7.6471637318198164e-13 -
                                                       z * 2.8114572543455206e-15)))))));
    const T c = 1.0 - z * (0.5 - z * (4.1666666666666664e-02 +
                                      z * (-1.3888888888888889e-03 +
                                           z * (2.4801587301587302e-05 +
                                                z * (-2.7557319223985888e-07 +
                                                     z * (2.0876756987868099e-09 -
                                                          z * (1.1470745597729725e-11 -
                                                               z * 4.7794773323873853e-14)))))));
    // quarters mod 4, in floating point
    const T turns = (quarters * 0.25 + kRound) - kRound;
    const T quarter = quarters - 4.0 * turns;  // -2, -1, 0, 1, 2
    const auto odd = quarter * quarter == T(1.0);
    const auto back = quarter * quarter == T(4.0);
    const T s0 = select(odd, c, s), c0 = select(odd, s, c);
    sine = select(back || quarter == T(-1.0), -s0, s0);
    cosine = select(back || quarter == T(1.0), -c0, c0);
}

}  // namespace limpet

template <int kWidth>
struct Eigen::NumTraits<limpet::Lanes<kWidth>> : Eigen::NumTraits<double> {
    using Real = limpet::Lanes<kWidth>;
    using NonInteger = Real;
    using Nested = Real;
    using Literal = double;
    enum {
        RequireInitialization = 0
    };
};
template <int kWidth, class Op>
struct Eigen::ScalarBinaryOpTraits<double, limpet::Lanes<kWidth>, Op> {
    using ReturnType = limpet::Lanes<kWidth>;
};
template <int kWidth, class Op>
struct Eigen::ScalarBinaryOpTraits<limpet::Lanes<kWidth>, double, Op> {
    using ReturnType = limpet::Lanes<kWidth>;
};
