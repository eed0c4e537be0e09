// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace limpet {

/// The most rotors that a vehicle has: six coaxial pairs. Source: PX4's CA_ROTOR_COUNT.
inline constexpr std::size_t kMaxRotors = 12;

/// One value a rotor, in the order of the vehicle file. Space for kMaxRotors, so that it is copied
/// without allocating; places beyond the count hold zeros.
template <class T>
class RotorList {
public:
    RotorList() { all_.fill(nothing()); }
    /// @param count  at most kMaxRotors; more are cut
    explicit RotorList(std::size_t count, const T& each = nothing()) : RotorList() {
        resize(count, each);
    }
    RotorList(std::initializer_list<T> each) : RotorList() {
        count_ = std::min(each.size(), kMaxRotors);
        std::copy_n(each.begin(), count_, all_.begin());
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// @param i  < kMaxRotors
    [[nodiscard]] T& operator[](std::size_t i) { return all_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return all_[i]; }
    [[nodiscard]] T* begin() { return all_.data(); }
    [[nodiscard]] T* end() { return all_.data() + count_; }
    [[nodiscard]] const T* begin() const { return all_.data(); }
    [[nodiscard]] const T* end() const { return all_.data() + count_; }
    [[nodiscard]] T* data() { return all_.data(); }
    [[nodiscard]] const T* data() const { return all_.data(); }

    /// @param count  at most kMaxRotors; more are cut
    /// @param each   of those that are new
    void resize(std::size_t count, const T& each = nothing()) {
        const std::size_t wanted = std::min(count, kMaxRotors);
        for (std::size_t i = std::min(wanted, count_); i < kMaxRotors; ++i) {
            all_[i] = i < wanted ? each : nothing();
        }
        count_ = wanted;
    }
    void fill(const T& value) { std::fill(begin(), end(), value); }

    friend bool operator==(const RotorList& a, const RotorList& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

    /// For visit_leaves(): as a vector, how many and then each.
    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        each(self.count_);
        for (auto& value : self) {
            each(value);
        }
    }

private:
    /// Eigen's vectors are no zeros by themselves.
    [[nodiscard]] static T nothing() {
        if constexpr (requires { T::Zero(); }) {
            return T::Zero();
        } else {
            return T{};
        }
    }

    std::array<T, kMaxRotors> all_;
    std::size_t count_ = 0;
};

}  // namespace limpet
