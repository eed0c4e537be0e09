// SPDX-License-Identifier: Apache-2.0
#include "signals.hpp"

#include <signal.h>

namespace limpet::app {
namespace {

/// A signal handler can reach nothing else.
std::atomic<bool> stop = false;

}  // namespace

const std::atomic<bool>* stop_on_signals() {
    struct sigaction action = {};
    action.sa_handler = [](int) { stop = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);  // the terminal is gone
    return &stop;
}

bool interrupted() {
    return stop;
}

}  // namespace limpet::app
