// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace limpet::companion {

/// The service manager that has started us, which starts us anew when it receives nothing from us:
/// systemd, by datagrams to the socket that the environment names. Says nothing where there is none
/// and never waits. Real time, not the companion's clock.
/// Source: sd_notify(3), sd_watchdog_enabled(3)
class ServiceManager {
public:
    /// By NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID of the environment.
    ServiceManager();
    ~ServiceManager();
    ServiceManager(const ServiceManager&) = delete;
    ServiceManager& operator=(const ServiceManager&) = delete;

    void ready();  ///< the loop runs
    /// Often, from the loop; says it four times in a watchdog's time.
    void alive();
    void stopping();  ///< the loop is over, files are being closed

private:
    void say(const char* word);

    std::string address_;  ///< as the kernel takes it
    int socket_ = -1;
    std::chrono::steady_clock::duration every_{0};  ///< 0: no watchdog
    std::chrono::steady_clock::time_point sent_;
};

}  // namespace limpet::companion
