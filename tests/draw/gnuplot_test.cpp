// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/gnuplot.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "../support/files.hpp"
#include "../support/flights.hpp"
#include "../support/png.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/pictures.hpp"

namespace limpet::draw {
namespace {

using testing::HasSubstr;
using testing::Property;
using testing::Throws;

TEST(Gnuplot, quotes_what_a_user_may_have_written) {
    EXPECT_EQ(gnuplot::literal("plain, 5°"), "\"plain, 5°\"");
    EXPECT_EQ(gnuplot::literal("it's"), "\"it\\047s\"");
    EXPECT_EQ(gnuplot::literal("a\nb"), "\"a b\"");
    const gnuplot::TemporaryFolder folder;
    const std::string nasty = "'\"; system(\"touch hurt\") \\ `touch hurt` $x {y}_z # ' \" °";
    gnuplot::run(folder.path(), "set print 'said.txt'\nprint " + gnuplot::literal(nasty));
    EXPECT_EQ(load_text(folder.path() / "said.txt"), nasty + "\n");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "hurt"));
}

TEST(Gnuplot, reports_its_own_words_when_a_script_is_wrong) {
    const gnuplot::TemporaryFolder folder;
    EXPECT_THAT([&] { gnuplot::run(folder.path(), "plot nonsense ("); },
                Throws<InternalError>(Property(&InternalError::what, HasSubstr("script.gp"))));
}

TEST(Gnuplot, says_what_to_install_when_it_is_not_there) {
    const gnuplot::TemporaryFolder folder;
    const test::Folder nothing;
    const test::Environment path("PATH", nothing.path().string());
    EXPECT_THAT(
        [&] { gnuplot::run(folder.path(), "print 1"); },
        Throws<InputError>(Property(&InputError::what, HasSubstr("apt-get install gnuplot-nox"))));
}

TEST(TemporaryFolder, goes_away_with_all_that_is_in_it) {
    std::filesystem::path path;
    {
        const gnuplot::TemporaryFolder folder;
        path = folder.path();
        std::ofstream(path / "file") << "text";
        EXPECT_TRUE(std::filesystem::exists(path / "file"));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Publish, replaces_a_file_and_leaves_nothing_else) {
    const test::Folder from, to;
    std::ofstream(from.path() / "a.png") << "new";
    std::ofstream(to.path() / "a.png") << "old and longer";
    const auto published = publish({from.path() / "a.png"}, to.path());
    ASSERT_EQ(published.size(), 1u);
    EXPECT_EQ(published[0], to.path() / "a.png");
    EXPECT_EQ(load_text(published[0]), "new");
    const auto left = std::distance(std::filesystem::directory_iterator(to.path()), {});
    EXPECT_EQ(left, 1);
}

TEST(Publish, names_the_folder_that_it_cannot_write) {
    const test::Folder folder;
    std::ofstream(folder.path() / "file") << "not a folder";
    EXPECT_THAT([&] { (void)publish({}, folder.path() / "file" / "inside"); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("file/inside"))));
}

}  // namespace
}  // namespace limpet::draw
