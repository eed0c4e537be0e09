// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/flights.hpp"
#include "limpet/report/page.hpp"
#include "program_output.hpp"
#include "sample_page.hpp"

/// Pages in a real browser (tests/support/browser).
namespace limpet::report {
namespace {

using Json = nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;

constexpr int kNoBrowser = 3;

class InABrowser : public testing::Test {
protected:
    void write(const std::string& html) const {
        std::ofstream(folder_.path() / "index.html", std::ios::binary) << html;
    }
    /// @return what the browser saw; discarded when there is none
    [[nodiscard]] Json look() const {
        const test::Output output =
            test::output_of(std::string(LIMPET_SOURCE_DIR) + "/tests/support/browser " +
                            (folder_.path() / "index.html").string());
        if (output.exit_code == kNoBrowser) {
            return Json::value_t::discarded;
        }
        EXPECT_THAT(output.exit_code, AnyOf(0, 1)) << output.text;
        return Json::parse(output.text, nullptr, false);
    }
    [[nodiscard]] std::string problems() const {
        const Json report = look();
        return report.is_discarded() ? "no browser" : report["problems"].dump();
    }
    test::Folder folder_;
};

TEST_F(InABrowser, the_page_has_no_fault) {
    test::draw_samples(folder_.path());
    std::filesystem::create_directories(folder_.path() / "flights");
    std::ofstream(folder_.path() / "flights" / "a b#1.mcap") << "a recording";
    write_page(test::sample_page(), folder_.path());
    const Json report = look();
    if (report.is_discarded()) {
        GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
    }
    EXPECT_EQ(report["problems"], Json::array()) << report.dump(2);
    EXPECT_EQ(report["console"], Json::array());
    EXPECT_EQ(report["requests"], Json::array());
    EXPECT_EQ(report["images"]["count"], 13);
    EXPECT_EQ(report["overflow"], Json({{"360", 0}, {"768", 0}, {"1200", 0}}));
}

// What the browser would say of a worse page: it can tell.
TEST_F(InABrowser, faults_are_seen) {
    write(
        "<!DOCTYPE html><title>bad</title><img src=\"data:image/png;base64,AAAA\" alt=\"broken\">"
        "<img src=\"https://example.invalid/x.png\" alt=\"far\">"
        "<a href=\"#nowhere\">a</a> <a href=\"gone.mcap\">b</a> <a href=\"javascript:1\">c</a>"
        "<div style=\"width:900px\">wide</div>"
        "<script>console.warn('hm'); throw new Error('thrown')</script>");
    const std::string found = problems();
    if (found == "no browser") {
        GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
    }
    for (const char* problem :
         {"image does not load: broken", "image does not load: far",
          "requests https://example.invalid/x.png", "console: hm", "thrown",
          "link to #nowhere leads nowhere", "gone.mcap", "javascript:1", "too wide at 360 px"}) {
        EXPECT_THAT(found, HasSubstr(problem));
    }
    EXPECT_THAT(found, testing::Not(HasSubstr("too wide at 1200 px")));
}

TEST_F(InABrowser, the_policy_of_the_page_stops_what_slipped_in) {
    test::draw_samples(folder_.path());
    std::string html = page_html(test::sample_page(), folder_.path());
    html.insert(html.find("<h1>"), "<script>document.title = 'taken'</script>");
    write(html);
    const std::string found = problems();
    if (found == "no browser") {
        GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
    }
    EXPECT_THAT(found, HasSubstr("Content Security Policy"));
}

}  // namespace
}  // namespace limpet::report
