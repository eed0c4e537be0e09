// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace limpet {

/// Two serial ports with a cable between them: pseudo-terminals, and a thread that carries bytes
/// from each to the other.
class NullModem {
public:
    NullModem();
    ~NullModem();
    NullModem(const NullModem&) = delete;
    NullModem& operator=(const NullModem&) = delete;

    [[nodiscard]] const std::string& device(int end) const { return device_[end]; }

private:
    void carry();

    int master_[2] = {-1, -1};
    int slave_[2] = {-1, -1};  ///< held open: a port that nobody has yet is no end of the cable
    std::string device_[2];
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

}  // namespace limpet
