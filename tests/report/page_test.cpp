// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/page.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "../support/files.hpp"
#include "../support/flights.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/html.hpp"
#include "sample_page.hpp"

namespace limpet::report {
namespace {

using testing::HasSubstr;
using testing::Property;
using testing::Throws;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

/// Drawn once for all tests of the page.
class PageHtml : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new test::Folder;
        test::draw_samples(folder_->path());
        html_ = new std::string(page_html(test::sample_page(), folder_->path()));
    }
    static void TearDownTestSuite() {
        delete html_;
        delete folder_;
    }
    static const std::string& html() { return *html_; }
    static const std::filesystem::path& folder() { return folder_->path(); }

    /// A sample page with a change must be refused with a word.
    static void refused(const std::function<void(Page&)>& change, const std::string& word) {
        Page page = test::sample_page();
        change(page);
        EXPECT_THAT([&] { (void)page_html(page, folder()); },
                    Throws<InternalError>(Property(&InternalError::what, HasSubstr(word))));
        EXPECT_THROW((void)results_json(page), InternalError);
    }

private:
    static inline test::Folder* folder_ = nullptr;
    static inline std::string* html_ = nullptr;
};

TEST_F(PageHtml, shows_no_text_as_markup) {
    EXPECT_EQ(count(html(), "<script"), 0u);
    EXPECT_EQ(count(html(), "<img src=x"), 0u);
    EXPECT_GT(count(html(), "&lt;script&gt;alert(1)&lt;/script&gt;"), 8u);
    EXPECT_EQ(count(html(), "<img "), 13u);
}

TEST_F(PageHtml, holds_its_pictures_and_asks_for_nothing) {
    EXPECT_EQ(count(html(), "src=\"data:image/"), 13u);
    EXPECT_EQ(count(html(), "src=\""), 13u);
    EXPECT_EQ(count(html(), "http://"), 0u);
    EXPECT_EQ(count(html(), "https://"), 0u);
    EXPECT_EQ(count(html(), "url("), 0u);
    EXPECT_EQ(count(html(), "default-src 'none'"), 1u);
}

TEST_F(PageHtml, has_a_row_for_every_claim_and_counts_the_verdicts) {
    EXPECT_EQ(count(html(), "<tr role=\"row\" id=\"c"), 24u);
    // Of the 24 the last 6 are so by construction, and one of those that differ is said twice.
    EXPECT_EQ(count(html(), "</span>6 measured: reproduced</span>"), 1u);
    EXPECT_EQ(count(html(), "</span>5 measured: differs</span>"), 1u);
    EXPECT_EQ(count(html(), "</span>not modelled</span>"), 7u);
    EXPECT_EQ(count(html(), "</span>hangs on assumptions</span>"), 1u);
    EXPECT_EQ(count(html(), "Hangs on <code>vehicle.slider.damping_N_s_m</code> 20 % less: 1.6."),
              1u);
}

TEST_F(PageHtml, gives_numbers_their_units_and_words_none) {
    EXPECT_EQ(count(html(), ">−0.0005 <span class=\"unit\">s</span>"), 1u);
    EXPECT_EQ(count(html(), ">+0.031 <span class=\"unit\">s</span>"), 1u);
    EXPECT_EQ(count(html(), ">0.8 … 1.4 <span class=\"unit\">s</span>"), 22u);
    EXPECT_EQ(count(html(), ">lets go at once</td>"), 1u);
}

TEST_F(PageHtml, leads_to_figures_and_recordings) {
    EXPECT_EQ(count(html(), "<a href=\"#fig-success\">figure</a>"), 6u);
    EXPECT_EQ(count(html(), "<figure id=\"fig-success\""), 1u);
    EXPECT_EQ(count(html(), "<a href=\"flights/a%20b%231.mcap\">recording</a>"), 5u);
}

TEST_F(PageHtml, leads_from_a_figure_to_its_replay_and_to_itself_at_full_size) {
    Page page = test::sample_page();
    for (PageSection& section : page.sections) {
        for (PageBlock& block : section.blocks) {
            if (auto* figure = std::get_if<PageFigure>(&block);
                figure && figure->id == "fig-success") {
                figure->view = "flights/a/view.html";
            }
        }
    }
    const std::string with = page_html(page, folder());
    EXPECT_EQ(count(with, "<div class=\"frame\"><a href=\"flights/a/view.html\"><img "), 1u);
    EXPECT_EQ(count(with, "<a href=\"flights/a/view.html\">replay in 3D</a>"), 1u);
    EXPECT_EQ(count(html(), "replay in 3D"), 0u);
    EXPECT_EQ(count(html(), "<div class=\"frame\"><a href=\""), 13u);
}

TEST_F(PageHtml, breaks_an_id_between_its_words_alone) {
    Page page = test::sample_page();
    page.claims[0].id = "metal-ripple_most";
    EXPECT_EQ(count(page_html(page, folder()), ">metal-<wbr>ripple_<wbr>most<"), 1u);
}

TEST_F(PageHtml, can_be_read_without_seeing) {
    EXPECT_EQ(count(html(), "<html lang=\"en\">"), 1u);
    EXPECT_EQ(count(html(), " alt=\"\""), 0u);
    EXPECT_EQ(count(html(), "<th scope=\"row\""), 5u) << "of the table";
    EXPECT_EQ(count(html(), "scope=\"col\""), 16u);
}

TEST_F(PageHtml, is_the_same_each_time) {
    EXPECT_TRUE(page_html(test::sample_page(), folder()) == html());
}

TEST_F(PageHtml, refuses_a_claim_that_leaves_something_blank) {
    refused([](Page& p) { p.claims[2].simulated = std::string(); }, "claim c3 is left blank");
    refused([](Page& p) { p.claims[2].difference = std::string("  "); }, "c3");
    refused([](Page& p) { p.claims[2].statement.clear(); }, "c3");
}

TEST_F(PageHtml, refuses_ids_that_are_none_or_twice_or_lead_nowhere) {
    refused([](Page& p) { p.claims[2].id = "c 3"; }, "'c 3'");
    refused([](Page& p) { p.claims[2].id = "c1"; }, "c1 is there twice");
    refused([](Page& p) { p.sections[0].id = "environment"; }, "environment is there twice");
    refused([](Page& p) { p.claims[2].figure = "claims"; }, "figure claims that is not there");
}

TEST_F(PageHtml, refuses_tables_and_figures_that_are_not_whole) {
    const auto table = [](Page& p) -> PageTable& {
        return std::get<PageTable>(p.sections[1].blocks[0]);
    };
    const auto figure = [](Page& p) -> PageFigure& {
        return std::get<PageFigure>(p.sections[2].blocks[0]);
    };
    refused([&](Page& p) { table(p).rows[1].pop_back(); }, "table-2");
    refused([&](Page& p) { table(p).rows[1][2] = std::string(); }, "table-2");
    refused([&](Page& p) { figure(p).alt.clear(); }, "fig-success");
    refused([&](Page& p) { figure(p).png = "/etc/passwd"; }, "fig-success");
    refused([](Page& p) { p.environment.erase(p.environment.begin()); }, "no version");
}

TEST_F(PageHtml, names_a_picture_that_is_not_there) {
    Page page = test::sample_page();
    std::get<PageFigure>(page.sections[2].blocks[0]).svg = "gone.svg";
    EXPECT_THAT([&] { (void)page_html(page, folder()); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("gone.svg"))));
}

TEST_F(PageHtml, is_written_with_its_data_or_not_at_all) {
    const test::Folder out;
    test::draw_samples(out.path());
    const auto files = write_page(test::sample_page(), out.path());
    ASSERT_EQ(files.size(), 2u);
    EXPECT_TRUE(load_text(out.path() / "index.html") == html());
    EXPECT_TRUE(load_text(out.path() / "results.json") == results_json(test::sample_page()));
    std::filesystem::remove(out.path() / "index.html");
    std::filesystem::remove(out.path() / "success.svg");
    EXPECT_THROW(write_page(test::sample_page(), out.path()), InputError);
    EXPECT_FALSE(std::filesystem::exists(out.path() / "index.html"));
}

TEST(Quantity, reads_as_people_write) {
    EXPECT_EQ(to_text(Quantity(1.25999)), "1.26");
    EXPECT_EQ(to_text(Quantity(-0.0)), "0");
    EXPECT_EQ(to_text(Quantity(101325.0)), "101325");
    EXPECT_EQ(to_text(Quantity(8.54858e-06)), "8.549e-06");
    EXPECT_EQ(to_text(Quantity(2.0), true), "+2");
    EXPECT_EQ(to_text(Quantity(0.0), true), "0");
    EXPECT_EQ(to_text(Quantity(-2.0), true), "−2");
    EXPECT_EQ(to_text(Quantity(draw::Range{0.8, 1.4})), "0.8 … 1.4");
    EXPECT_EQ(to_text(Quantity(std::numeric_limits<double>::quiet_NaN())), "not a number");
}

TEST(Html, marks_up_pairs_and_leaves_the_rest) {
    EXPECT_EQ(draw::html::marked_up("**a** <b> `c` **d"),
              "<strong>a</strong> &lt;b&gt; <code>c</code> **d");
    EXPECT_EQ(draw::html::marked_up("2 * 3 ` 4"), "2 * 3 ` 4");
    EXPECT_EQ(draw::html::escaped("a\"'\x01&"), "a&quot;&#39; &amp;");
}

TEST(Html, links_name_files_whatever_they_are_called) {
    EXPECT_EQ(draw::html::link("a/b c.mcap"), "a/b%20c.mcap");
    EXPECT_EQ(draw::html::link("javascript:alert(1)"), "javascript%3Aalert%281%29");
    EXPECT_EQ(draw::html::link("//host/x"), ".//host/x");
    EXPECT_EQ(draw::html::link("ü#?"), "%C3%BC%23%3F");
}

TEST(Html, base64_is_that_of_rfc_4648) {
    const char* const texts[] = {"", "f", "fo", "foo", "foob", "fooba", "foobar", "\xff\xfe\xfd"};
    const char* const coded[] = {"",         "Zg==",     "Zm8=",     "Zm9v",
                                 "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy", "//79"};
    for (std::size_t i = 0; i < std::size(texts); ++i) {
        EXPECT_EQ(draw::html::base64(texts[i]), coded[i]);
    }
}

TEST(Html, embeds_nothing_but_pictures) {
    EXPECT_THROW((void)draw::html::embedded("<html>"), InternalError);
    EXPECT_THROW((void)draw::html::embedded(""), InternalError);
}

}  // namespace
}  // namespace limpet::report
