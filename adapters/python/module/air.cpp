// SPDX-License-Identifier: Apache-2.0
#include "air.hpp"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

namespace limpet::python {
namespace {

std::atomic<int> in_the_air = 0;
std::atomic<bool> ends = false;

/// At the interpreter's exit, which runs this with the GIL, while all of Python is still there.
void wait_until_all_are_down() {
    constexpr auto kLookAgain = std::chrono::milliseconds(1);
    constexpr auto kLongest = std::chrono::seconds(60);  // a user's station may wait for ever
    ends = true;
    const auto until = std::chrono::steady_clock::now() + kLongest;
    const py::gil_scoped_release land;
    while (in_the_air > 0 && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(kLookAgain);
    }
}

}  // namespace

InTheAir::InTheAir() {
    if (ends) {  // under the GIL: a flight that begins is counted before the exit looks
        throw InterpreterEnds();
    }
    ++in_the_air;
}

InTheAir::~InTheAir() {
    --in_the_air;
}

bool interpreter_ends() {
    return ends;
}

void add_air() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) {
                std::rethrow_exception(std::move(thrown));
            }
        } catch (const InterpreterEnds&) {
            PyErr_SetString(PyExc_SystemExit, "the interpreter ends");
        }
    });
    py::module_::import("atexit").attr("register")(py::cpp_function(wait_until_all_are_down));
}

}  // namespace limpet::python
