// SPDX-License-Identifier: Apache-2.0
// A ground station watches the real program over UDP.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <future>
#include <map>

#include "limpet/mavlink/key_file.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/record/recording.hpp"
#include "program.hpp"
#include "tests/mavlink/version_1.hpp"

namespace limpet {
namespace {

using namespace mavlink;
using testing::Contains;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

/// What a ground station has gathered.
class GroundView {
public:
    GroundView() : GroundView(open_transport({.medium = wire::Medium::udp}, wire::Role::listen)) {}

    [[nodiscard]] std::string address() const {
        return "udp:127.0.0.1:" + std::to_string(link.transport().address().port);
    }
    /// Reads until something is so, or for as long as no healthy flight here takes.
    bool until(const std::function<bool()>& so) {
        const auto end = Clock::now() + std::chrono::seconds(60);
        while (!so()) {
            if (Clock::now() > end) {
                return false;
            }
            if (const auto frame = link.receive(std::chrono::milliseconds(50))) {
                take(*frame);
            }
        }
        return true;
    }
    [[nodiscard]] bool received_text(const std::string& text) const {
        return texts.find(text) != std::string::npos;
    }
    void set(const char* name, float value) {
        mavlink::ParamSet message{
            .target_system = 1, .target_component = 1, .param_value = value, .param_type = 9};
        set_text(message.param_id, name);
        EXPECT_EQ(link.send(message), wire::TransferStatus::done);
    }

    wire::Transport& transport;  ///< the link's
    mavlink::Link link;
    std::map<std::uint32_t, int> received;
    std::map<std::string, float> parameters;
    int parameter_count = -1;
    std::string texts;
    bool armed = false;

private:
    explicit GroundView(std::unique_ptr<wire::Transport> opened)
        : transport(*opened),
          link(std::move(opened), {.system = 255, .component = mavlink::kGroundStationComponent}) {}
    void take(const mavlink::Frame& frame) {
        ++received[frame.id];
        if (const auto value = decode<mavlink::ParamValue>(frame)) {
            parameters[std::string(text_of(value->param_id))] = value->param_value;
            parameter_count = value->param_count;
        } else if (const auto text = decode<mavlink::StatusText>(frame)) {
            texts += text_of(text->text);
            texts += text->id == 0 ? "\n" : "";
        } else if (const auto beat = decode<mavlink::Heartbeat>(frame)) {
            armed = (beat->base_mode & 128) != 0;
        }
    }
};

std::future<Finished> start(const Bench& bench, std::vector<std::string> arguments) {
    return std::async(std::launch::async,
                      [&bench, arguments = std::move(arguments)] { return bench.run(arguments); });
}

TEST(GroundStation, SeesAFlightAndSetsItsParameters) {
    const Bench bench;
    GroundView view;
    auto flight = start(bench, {"fly", "hover", "--set", "simulation.hover_s=20", "--speed", "4",
                                "--no-figures", "--out", ".", "--ground-station", view.address()});
    ASSERT_TRUE(view.until([&] { return view.received[mavlink::Heartbeat::kId] > 0; }));
    EXPECT_TRUE(view.armed);
    EXPECT_EQ(view.link.send(mavlink::ParamRequestList{.target_system = 1}),
              wire::TransferStatus::done);
    // All but the earth's field: its names do not fit the wire.
    EXPECT_TRUE(view.until([&] {
        return view.parameter_count > 0 &&
               view.parameters.size() == static_cast<std::size_t>(view.parameter_count);
    }));
    EXPECT_EQ(view.parameters.at("MC_PITCHRATE_P"), 0.15F);
    EXPECT_EQ(view.parameters.count("mag_field_down_gauss"), 0U);
    view.set("MC_PITCHRATE_P", 0.125F);
    EXPECT_TRUE(view.until([&] { return view.parameters["MC_PITCHRATE_P"] == 0.125F; }));
    view.set("MPC_THR_HOVER", 7.0F);
    EXPECT_TRUE(view.until([&] { return view.received_text("MPC_THR_HOVER = 7 refused"); }));
    EXPECT_TRUE(view.until([&] { return view.received_text("released: "); }));
    EXPECT_TRUE(view.received_text("parameter_set, MC_PITCHRATE_P 0.125\n"));
    for (const std::uint32_t id :
         {mavlink::SysStatus::kId, mavlink::Attitude::kId, mavlink::LocalPositionNed::kId,
          mavlink::GlobalPositionInt::kId, mavlink::HomePosition::kId, BatteryStatus::kId,
          mavlink::DistanceSensor::kId, mavlink::ExtendedSysState::kId}) {
        EXPECT_GT(view.received[id], 3) << id;
    }

    const Finished finished = flight.get();
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("parameter_set      MC_PITCHRATE_P = 0.125"));
    const record::Recording recording = record::read_recording(bench.folder() / "flight.mcap");
    EXPECT_EQ(recording.damage, "");
    std::vector<std::string> names;
    for (const record::RecordedEvent& event : recording.events) {
        names.push_back(event.name);
    }
    EXPECT_THAT(names, Contains("parameter_set"));
}

TEST(GroundStation, WithAKeyServesOnlyWhoHasIt) {
    const Bench bench;
    const auto file = bench.write("key", std::string(64, '7') + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_read);
    GroundView view;
    auto flight =
        start(bench, {"fly", "hover", "--set", "simulation.hover_s=20", "--speed", "4",
                      "--no-record", "--ground-station", view.address(), "--signing-key", "key"});
    ASSERT_TRUE(view.until([&] { return view.received[mavlink::Heartbeat::kId] > 0; }));
    view.set("MC_PITCHRATE_P", 0.1F);  // unsigned
    view.link.sign({.key = read_signing_key(file), .link_id = 3, .unix_us = [] {
                        return static_cast<std::uint64_t>(
                            std::chrono::duration_cast<std::chrono::microseconds>(
                                std::chrono::system_clock::now().time_since_epoch())
                                .count());
                    }});
    view.set("MC_ROLLRATE_P", 0.1F);
    EXPECT_TRUE(view.until([&] { return view.parameters["MC_ROLLRATE_P"] == 0.1F; }));
    EXPECT_TRUE(view.until([&] { return view.received_text("released: "); }));
    EXPECT_EQ(view.parameters.count("MC_PITCHRATE_P"), 0U);
    const Finished finished = flight.get();
    EXPECT_THAT(finished.out, HasSubstr("ground station: refused: not signed\n"));
    EXPECT_THAT(finished.out, HasSubstr("1 frames refused: 1 not signed"));
    EXPECT_THAT(finished.out, Not(HasSubstr("MC_PITCHRATE_P")));
}

TEST(GroundStation, ThatSpeaksMavlink1IsToldSo) {
    const Bench bench;
    GroundView view;
    auto flight = start(bench, {"fly", "hover", "--set", "simulation.hover_s=10", "--speed", "4",
                                "--no-record", "--ground-station", view.address()});
    ASSERT_TRUE(view.until([&] { return view.received[mavlink::Heartbeat::kId] > 0; }));
    EXPECT_EQ(view.transport.send(heartbeat_of_version_1(), std::chrono::seconds(1)).status,
              wire::TransferStatus::done);
    EXPECT_TRUE(view.until([&] { return view.received_text("released: "); }));
    const Finished finished = flight.get();
    EXPECT_THAT(finished.out, HasSubstr("ground station: refused: MAVLink 1, which is not read: "
                                        "MAV_PROTO_VER 2 makes a PX4 speak MAVLink 2\n"));
    EXPECT_THAT(finished.out, HasSubstr("1 frames refused: 1 in MAVLink 1"));
}

TEST(GroundStation, ThatIsNotThereChangesNothing) {
    const Bench bench;
    const std::string nobody = GroundView().address();  // free again
    const Finished with = bench.run({"fly", "perch_concrete", "--json", "--out", "a", "--speed",
                                     "max", "--ground-station", nobody});
    ASSERT_EQ(with.exit_code, 0) << with.err;
    ASSERT_EQ(bench.run({"fly", "perch_concrete", "--json", "--out", "b"}).exit_code, 0);
    EXPECT_TRUE(text_of(bench.folder() / "a/flight.mcap") ==
                text_of(bench.folder() / "b/flight.mcap"));
}

TEST(GroundStation, RefusesInOneLine) {
    const Bench bench;
    (void)bench.write("open_key", std::string(64, '7'));
    std::filesystem::permissions(bench.folder() / "open_key", std::filesystem::perms::all);
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
        {{"--ground-station", "udp:nowhere:14550"}, "nowhere"},
        {{"--ground-station", "smoke:127.0.0.1:1"}, "smoke"},
        {{"--signing-key", "open_key"}, "--ground-station"},
        {{"--ground-station", "--signing-key", "open_key"}, "mode 0777"},
        {{"--ground-station", "udp:14550", "--signing-key", "none"}, "No such file"},
        {{"--ground-station", "udp:14550", "--autopilot", "px4"}, "built-in"},
    };
    for (const auto& [arguments, part] : wrong) {
        std::vector<std::string> all = {"fly", "hover", "--no-record"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Finished done = bench.run(all);
        EXPECT_EQ(done.exit_code, 2) << part;
        EXPECT_TRUE(done.one_line_of_error()) << done.err;
        EXPECT_THAT(done.err, HasSubstr(part));
    }
}

}  // namespace
}  // namespace limpet
