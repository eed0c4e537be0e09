// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/address.hpp"

#include <gmock/gmock.h>

#include "wires.hpp"

using namespace limpet;
using namespace limpet::wire;
using namespace limpet::wire::wires;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Address, NamesMediumHostAndPort) {
    const wire::TransportAddress tcp = wire::parse_address("tcp:10.0.0.7:4560");
    EXPECT_EQ(tcp.medium, wire::Medium::tcp);
    EXPECT_EQ(tcp.host, "10.0.0.7");
    EXPECT_EQ(tcp.port, 4560);
    const wire::TransportAddress udp = wire::parse_address("udp:localhost:65535");
    EXPECT_EQ(udp.medium, wire::Medium::udp);
    EXPECT_EQ(udp.host, "127.0.0.1");
    EXPECT_EQ(udp.port, 65535);
}

TEST(Address, WithoutAHostIsLoopback) {
    EXPECT_EQ(wire::parse_address("tcp:4560").host, "127.0.0.1");
    EXPECT_EQ(wire::parse_address("udp:1").host, "127.0.0.1");
}

TEST(Address, NamesDeviceAndBaud) {
    const wire::TransportAddress serial = wire::parse_address("serial:/dev/serial/by-id/a:b:57600");
    EXPECT_EQ(serial.medium, wire::Medium::serial);
    EXPECT_EQ(serial.device, "/dev/serial/by-id/a:b");
    EXPECT_EQ(serial.baud, 57600U);
    EXPECT_EQ(wire::parse_address("serial:/dev/ttyUSB0:3000000").baud, 3000000U);
}

TEST(Address, NamesGroupAndInterface) {
    const wire::TransportAddress motive =
        wire::parse_address("udp-multicast:239.255.42.99:1511@192.168.1.5");
    EXPECT_EQ(motive.medium, wire::Medium::udp_multicast);
    EXPECT_EQ(motive.host, "239.255.42.99");
    EXPECT_EQ(motive.interface, "192.168.1.5");
    EXPECT_EQ(wire::parse_address("udp-multicast:224.0.0.1:1").interface, "");
}

TEST(Address, IsWrittenAsItIsRead) {
    for (const char* text :
         {"tcp:0.0.0.0:4560", "udp:127.0.0.1:14550", "udp-broadcast:192.168.1.255:14550",
          "udp-multicast:239.255.42.99:1511@127.0.0.1", "udp-multicast:239.255.42.99:1511",
          "serial:/dev/ttyACM0:921600"}) {
        EXPECT_EQ(wire::to_text(wire::parse_address(text)), text);
    }
}

namespace {
struct Wrong {
    const char* text;
    const char* why;
};
class WrongAddress : public testing::TestWithParam<Wrong> {};
}  // namespace

TEST_P(WrongAddress, IsRefusedInOneLineThatSaysWhy) {
    const std::string line = refusal([] { (void)wire::parse_address(GetParam().text); });
    EXPECT_THAT(line, AllOf(HasSubstr("address '" + std::string(GetParam().text) + "': "),
                            HasSubstr(GetParam().why), Not(HasSubstr("\n"))));
}

INSTANTIATE_TEST_SUITE_P(
    Table, WrongAddress,
    testing::Values(
        Wrong{"", "allowed are tcp:127.0.0.1:4560"}, Wrong{"tcp", "allowed are tcp:"},
        Wrong{"TCP:127.0.0.1:1", "allowed are tcp:"}, Wrong{"http://a", "allowed are tcp:"},
        Wrong{"/dev/ttyACM0", "allowed are"}, Wrong{"127.0.0.1:4560", "allowed are"},
        Wrong{"tcp:127.0.0.1:0", "port '0' is not a whole number from 1 to 65535"},
        Wrong{"tcp:127.0.0.1:65536", "port '65536' is not a whole number from 1 to 65535"},
        Wrong{"tcp:127.0.0.1:99999999999", "port '99999999999'"},
        Wrong{"tcp:127.0.0.1:-1", "port '-1'"}, Wrong{"tcp:127.0.0.1:+1", "port '+1'"},
        Wrong{"tcp:127.0.0.1: 1", "port ' 1'"}, Wrong{"tcp:127.0.0.1:4560x", "port '4560x'"},
        Wrong{"tcp:127.0.0.1:45.6", "port '45.6'"}, Wrong{"tcp:127.0.0.1:", "port ''"},
        Wrong{"tcp:", "port ''"}, Wrong{"tcp:127.0.0.1", "port '127.0.0.1'"},
        Wrong{"tcp::4560", "host '' is not an IPv4 address in digits"},
        Wrong{"tcp:pixhawk:4560", "host 'pixhawk'"}, Wrong{"tcp:127.0.0.256:4560", "host '127.0."},
        Wrong{"tcp:127.1:4560", "host '127.1'"}, Wrong{"tcp:[::1]:4560", "host '[::1]'"},
        Wrong{"udp:127.0.0.1:1:2", "host '127.0.0.1:1'"},
        Wrong{"udp:239.255.42.99:1511", "write udp-multicast:"},
        Wrong{"tcp:224.0.0.1:1511", "is a multicast group"},
        Wrong{"udp:255.255.255.255:14550", "write udp-broadcast:"},
        Wrong{"udp-broadcast:14550", "HOST:PORT"}, Wrong{"udp-multicast:1511", "HOST:PORT"},
        Wrong{"udp-broadcast:239.1.1.1:1", "write udp-multicast:"},
        Wrong{"udp-multicast:223.255.255.255:1", "group '223.255.255.255' is not in"},
        Wrong{"udp-multicast:240.0.0.0:1", "group '240.0.0.0' is not in"},
        Wrong{"udp-multicast:239.1.1.1:1@eth0", "interface 'eth0'"},
        Wrong{"serial:", "allowed is serial:DEVICE:BAUD"},
        Wrong{"serial:/dev/ttyACM0", "allowed is serial:DEVICE:BAUD"},
        Wrong{"serial::921600", "allowed is serial:DEVICE:BAUD"},
        Wrong{"serial:/dev/ttyACM0:57599", "baud '57599' is not a whole number from 57600"},
        Wrong{"serial:/dev/ttyACM0:3000001", "baud '3000001'"},
        Wrong{"serial:/dev/ttyACM0:fast", "baud 'fast'"},
        Wrong{"serial:/dev/ttyACM0:", "baud ''"}));
