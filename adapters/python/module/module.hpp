// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/core/rotor_list.hpp"

// What the module is made of, a file each; module.cpp puts them together.
namespace limpet::python {

namespace py = pybind11;

void add_signals(py::module_& module);
void add_stations(py::module_& module);
void add_flight(py::module_& module);
void add_vector(py::module_& module);
void add_campaign(py::module_& module);

/// x, y, z as a new array.
[[nodiscard]] inline py::array_t<double> array_of(const Vector3& v) {
    return py::array_t<double>(3, v.data());
}
/// w, x, y, z.
[[nodiscard]] inline py::array_t<double> array_of(const Quaternion& q) {
    const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
    return py::array_t<double>(4, wxyz.data());
}
template <std::size_t kCount>
[[nodiscard]] py::array_t<double> array_of(const std::array<double, kCount>& numbers) {
    return py::array_t<double>(kCount, numbers.data());
}
[[nodiscard]] inline py::array_t<double> array_of(const RotorList<double>& numbers) {
    return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}
/// An array over numbers that `owner` keeps alive: nothing is copied.
[[nodiscard]] inline py::array_t<double> view_of(std::span<const double> numbers,
                                                 py::handle owner) {
    py::array_t<double> view(static_cast<py::ssize_t>(numbers.size()), numbers.data(), owner);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

/// Three numbers of Python's.
/// @throws py::value_error
[[nodiscard]] Vector3 vector_from(const py::handle& numbers, const char* what);
/// Four numbers w, x, y, z, made a unit quaternion.
[[nodiscard]] Quaternion quaternion_from(const py::handle& numbers, const char* what);

}  // namespace limpet::python
