// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "limpet/core/frames.hpp"
#include "limpet/core/unrolled.hpp"

// Spatial algebra about one point in one frame: turning before moving, moments before forces.
// Bodies that are all expressed about the base's origin in the base's axes need no transforms
// between them. Source: Featherstone, "Rigid Body Dynamics Algorithms", 2008, chapters 2 and 7.
namespace limpet::plant {

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;

/// The twist of a turn about y past a point: half of its six numbers are zeros.
template <class T>
struct TurnAboutY {
    T x_m{}, z_m{};  ///< of the point
};

/// A twist (angular velocity, velocity) or a wrench (moment, force).
template <class T>
struct Spatial {
    std::array<T, 6> at{};

    static Spatial of(const Vec3<T>& turning, const Vec3<T>& moving) {
        return {{turning.x(), turning.y(), turning.z(), moving.x(), moving.y(), moving.z()}};
    }
    /// A wrench about the origin of a force at a point and a moment.
    static Spatial wrench(const Vec3<T>& p, const Vec3<T>& force, const Vec3<T>& moment) {
        return of(moment + p.cross(force), force);
    }
    [[nodiscard]] Vec3<T> turning() const { return {at[0], at[1], at[2]}; }
    [[nodiscard]] Vec3<T> moving() const { return {at[3], at[4], at[5]}; }
    /// Of a twist: how a point moves.
    [[nodiscard]] Vec3<T> moving_at(const Vec3<T>& p) const {
        return moving() + turning().cross(p);
    }

    T& operator[](int i) { return at[static_cast<std::size_t>(i)]; }
    const T& operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
    [[gnu::always_inline]] Spatial& operator+=(const Spatial& other) {
        unrolled<6>([&](auto i) [[gnu::always_inline]] { at[i.value] += other.at[i.value]; });
        return *this;
    }
    /// this += factor other
    [[gnu::always_inline]] void add(const T& factor, const Spatial& other) {
        unrolled<6>([&](auto i)
                        [[gnu::always_inline]] { at[i.value] += factor * other.at[i.value]; });
    }
    [[gnu::always_inline]] void add(const T& factor, const TurnAboutY<T>& turn) {
        at[1] += factor;
        at[3] -= factor * turn.z_m;
        at[5] += factor * turn.x_m;
    }
    [[nodiscard]] [[gnu::always_inline]] T dot(const TurnAboutY<T>& turn) const {
        return at[1] - turn.z_m * at[3] + turn.x_m * at[5];
    }
    [[nodiscard]] [[gnu::always_inline]] T dot(const Spatial& other) const {
        T sum = at[0] * other.at[0];
        unrolled<5>([&](auto i)
                        [[gnu::always_inline]] { sum += at[i.value + 1] * other.at[i.value + 1]; });
        return sum;
    }
};

/// A symmetric matrix from twists to wrenches, of which the lower triangle is kept.
template <class T>
struct SpatialInertia {
    std::array<T, 21> lower{};

    static constexpr std::size_t place(int i, int j) {
        return static_cast<std::size_t>(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i);
    }
    T& operator()(int i, int j) { return lower[place(i, j)]; }
    const T& operator()(int i, int j) const { return lower[place(i, j)]; }

    [[gnu::always_inline]] SpatialInertia& operator+=(const SpatialInertia& other) {
        unrolled<21>([&](auto i)
                         [[gnu::always_inline]] { lower[i.value] += other.lower[i.value]; });
        return *this;
    }
    /// Of a rigid body.
    /// @param own  about its centre c
    static SpatialInertia of_body(const T& mass, const Vec3<T>& c, const Mat3<T>& own) {
        const Vec3<T> h = mass * c;
        const T xx = h.x() * c.x(), yy = h.y() * c.y(), zz = h.z() * c.z();
        const T none(0.0);
        // clang-format off
        return {{own(0, 0) + yy + zz,
                 own(1, 0) - h.x() * c.y(), own(1, 1) + xx + zz,
                 own(2, 0) - h.x() * c.z(), own(2, 1) - h.y() * c.z(), own(2, 2) + xx + yy,
                 none,   h.z(),  -h.y(), mass,
                 -h.z(), none,   h.x(),  none, mass,
                 h.y(),  -h.x(), none,   none, none, mass}};
        // clang-format on
    }
    /// Of a rigid body: its moment of inertia about the origin, times a vector.
    [[nodiscard]] Vec3<T> turned(const Vec3<T>& w) const {
        const SpatialInertia& I = *this;
        return {I(0, 0) * w.x() + I(1, 0) * w.y() + I(2, 0) * w.z(),
                I(1, 0) * w.x() + I(1, 1) * w.y() + I(2, 1) * w.z(),
                I(2, 0) * w.x() + I(2, 1) * w.y() + I(2, 2) * w.z()};
    }
    /// Of a rigid body: mass times centre.
    [[nodiscard]] Vec3<T> mass_moment() const {
        return {(*this)(4, 2), (*this)(5, 0), (*this)(3, 1)};
    }
    /// += springs at a point: translation and rotation there, each a symmetric 3 by 3.
    void add_springs_at(const Vec3<T>& p, const Mat3<T>& translation, const Mat3<T>& rotation) {
        Mat3<T> across;  // moments by translation
        for (int k = 0; k < 3; ++k) {
            across.col(k) = p.cross(translation.col(k));
        }
        for (int i = 0; i < 3; ++i) {
            const Vec3<T> turned = p.cross(Vec3<T>(across.row(i).transpose()));
            for (int k = 0; k <= i; ++k) {
                (*this)(i, k) += rotation(i, k) + turned[k];
                (*this)(3 + i, 3 + k) += translation(i, k);
            }
            for (int k = 0; k < 3; ++k) {
                (*this)(3 + k, i) += across(i, k);
            }
        }
    }
    /// += gain v v'
    [[gnu::always_inline]] void add_square(const T& gain, const Spatial<T>& v) {
        unrolled<6>([&](auto i) [[gnu::always_inline]] {
            const T scaled = gain * v.at[i.value];
            unrolled<i.value + 1>([&](auto j) [[gnu::always_inline]] {
                (*this)(i.value, j.value) += scaled * v.at[j.value];
            });
        });
    }
    [[nodiscard]] [[gnu::always_inline]] Spatial<T> times(const Spatial<T>& v) const {
        Spatial<T> product;
        unrolled<6>([&](auto i) [[gnu::always_inline]] {
            T sum = (*this)(i.value, 0) * v.at[0];
            unrolled<5>([&](auto j) [[gnu::always_inline]] {
                sum += (*this)(i.value, j.value + 1) * v.at[j.value + 1];
            });
            product.at[i.value] = sum;
        });
        return product;
    }
    [[nodiscard]] [[gnu::always_inline]] Spatial<T> times(const TurnAboutY<T>& turn) const {
        Spatial<T> product;
        unrolled<6>([&](auto i) [[gnu::always_inline]] {
            product.at[i.value] = (*this)(i.value, 1) - turn.z_m * (*this)(i.value, 3) +
                                  turn.x_m * (*this)(i.value, 5);
        });
        return product;
    }
    /// Becomes L (below the diagonal) and 1 / D (on it) of itself = L D L'.
    [[gnu::always_inline]] void factorise() {
        unrolled<6>([&](auto i) [[gnu::always_inline]] {
            constexpr int kRow = i.value;
            unrolled<kRow>([&](auto j) [[gnu::always_inline]] {
                T sum = (*this)(kRow, j.value);
                unrolled<j.value>([&](auto k) [[gnu::always_inline]] {
                    sum -= (*this)(kRow, k.value) * (*this)(j.value, k.value);
                });
                (*this)(kRow, j.value) = sum;  // still times D
            });
            T pivot = (*this)(kRow, kRow);
            unrolled<kRow>([&](auto j) [[gnu::always_inline]] {
                const T scaled = (*this)(kRow, j.value) * (*this)(j.value, j.value);
                pivot -= scaled * (*this)(kRow, j.value);
                (*this)(kRow, j.value) = scaled;
            });
            (*this)(kRow, kRow) = 1.0 / pivot;
        });
    }
    /// x of I x = b, after factorise().
    [[nodiscard]] [[gnu::always_inline]] Spatial<T> solve(Spatial<T> b) const {
        unrolled<6>([&](auto i) [[gnu::always_inline]] {
            unrolled<i.value>([&](auto j) [[gnu::always_inline]] {
                b.at[i.value] -= (*this)(i.value, j.value) * b.at[j.value];
            });
        });
        unrolled<6>([&](auto i)
                        [[gnu::always_inline]] { b.at[i.value] *= (*this)(i.value, i.value); });
        unrolled<6>([&](auto up) [[gnu::always_inline]] {
            constexpr int kRow = 5 - up.value;
            unrolled<kRow>([&](auto j) [[gnu::always_inline]] {
                b.at[j.value] -= (*this)(kRow, j.value) * b.at[kRow];
            });
        });
        return b;
    }
};

/// A joint taken out of the bodies beyond it: they hang on its near side as one, articulated.
template <class T>
struct Eliminated {
    Spatial<T> u;  ///< I S
    T inverse{};   ///< 1 / (S' I S + what a spring in the joint resists within the step)
};

}  // namespace limpet::plant
