// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/html.hpp"
#include "limpet/record/recorder.hpp"

namespace limpet::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::filesystem::path recorded(const TestFolder& folder, const char* name, bool scene) {
    record::RecordingInfo info{
        .scenario = "a", .version = "0", .attachments = {}, .range_sensor = {}};
    if (scene) {
        info.scene = record::Scene{.robot_description = "<robot/>"};
    }
    record::Recorder recorder(folder / name, info);
    recorder.truth(Truth{});
    recorder.finish("{}");
    return folder / name;
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string why_not(const std::filesystem::path& recording) {
    try {
        (void)view_html({recording});
    } catch (const InputError& problem) {
        return problem.what();
    }
    return "";
}

TEST(View, ThePageHoldsItsRecordingsAndAsksForNothing) {
    if (!has_view_page()) {
        GTEST_SKIP() << "built without Node";
    }
    const TestFolder folder;
    const auto one = recorded(folder, "one.mcap", true);
    const auto two = recorded(folder, "a <\"two\">.mcap", true);
    const std::string html = view_html({one, two});
    EXPECT_THAT(html, HasSubstr(draw::html::base64(bytes_of(one))));
    EXPECT_THAT(html, HasSubstr("data-recording=\"one\""));
    EXPECT_THAT(html, HasSubstr("data-recording=\"a &lt;&quot;two&quot;&gt;\""));
    EXPECT_THAT(html, AllOf(Not(HasSubstr("<script src")), Not(HasSubstr("<link rel=\"style"))));
}

TEST(View, RefusesWhatItCannotShow) {
    const TestFolder folder;
    const auto bare = recorded(folder, "bare.mcap", false);
    if (has_view_page()) {
        EXPECT_THAT(why_not(bare), AllOf(HasSubstr("bare.mcap: there is no /robot_description"),
                                         HasSubstr("limpet fly")));
        EXPECT_THAT(why_not(folder / "none.mcap"), HasSubstr("none.mcap"));
    } else {
        EXPECT_THAT(why_not(bare), HasSubstr("nodejs"));
    }
}

}  // namespace
}  // namespace limpet::report
