// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

#include "air.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/version.hpp"

PYBIND11_MODULE(_core, module) {
    using namespace limpet;
    namespace py = pybind11;
    module.doc() = "What limpet's Python package is made of; use limpet itself.";
    module.attr("__version__") = std::string(library_version());
    py::register_exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
        "Input that cannot be used: one line with the place, the value and what is allowed.";
    py::register_exception<InternalError>(module, "InternalError", PyExc_RuntimeError).doc() =
        "A fault of Limpet's: please report it.";
    python::add_air();
    python::add_signals(module);
    python::add_stations(module);
    python::add_flight(module);
    python::add_vector(module);
    python::add_campaign(module);
}
