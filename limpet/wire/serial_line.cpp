// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/serial_line.hpp"

// The kernel's termios2 takes a baud as a number; its header and <termios.h>, which Asio includes,
// exclude each other: hence a file of its own. Source: ioctl_tty(2).
#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstdlib>

namespace limpet::wire {

int set_line(int descriptor, unsigned baud) {
    termios2 line{};
    if (ioctl(descriptor, TCGETS2, &line) != 0) {
        return errno;
    }
    line.c_iflag = 0;
    line.c_oflag = 0;
    line.c_lflag = 0;
    line.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
    line.c_cc[VMIN] = 1;  // with 0 a read of nothing would look like the end of the line
    line.c_cc[VTIME] = 0;
    line.c_ispeed = baud;
    line.c_ospeed = baud;
    if (ioctl(descriptor, TCSETS2, &line) != 0) {
        return errno;
    }
    termios2 taken{};
    if (ioctl(descriptor, TCGETS2, &taken) != 0) {
        return errno;
    }
    // Two ends of 8N1 understand each other up to some 5 % of difference; we leave the other end 2.
    const long off = std::labs(static_cast<long>(taken.c_ospeed) - static_cast<long>(baud));
    return off * 100 < static_cast<long>(baud) * 3 ? 0 : EINVAL;
}

void flush_line(int descriptor) {
    ioctl(descriptor, TCFLSH, TCIOFLUSH);
}

}  // namespace limpet::wire
