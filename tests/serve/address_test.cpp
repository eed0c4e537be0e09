// SPDX-License-Identifier: Apache-2.0
#include "limpet/serve/address.hpp"

#include <gmock/gmock.h>

#include "limpet/core/errors.hpp"

using namespace limpet;
using namespace limpet::serve;
using testing::ElementsAre;
using testing::Pair;

namespace {

TEST(Target, TheTokenIsTakenOutOfPathOrQuery) {
    const Target in_path = parse_target("/abc/api/flights?which=2%263&name=a+b", "abc");
    EXPECT_EQ(in_path.token, "abc");
    EXPECT_EQ(in_path.request.path, "/api/flights");
    EXPECT_THAT(in_path.request.query, ElementsAre(Pair("which", "2&3"), Pair("name", "a b")));
    EXPECT_EQ(in_path.request.value("which"), "2&3");
    EXPECT_EQ(in_path.request.value("absent", "so"), "so");

    const Target in_query = parse_target("/?token=abc", "abc");
    EXPECT_EQ(in_query.token, "abc");
    EXPECT_EQ(in_query.request.path, "/");
    EXPECT_TRUE(in_query.request.query.empty());

    EXPECT_EQ(parse_target("/abc", "abc").request.path, "/");
    EXPECT_EQ(parse_target("/abcd/x", "abc").request.path, "/abcd/x");
    EXPECT_EQ(parse_target("/x", "").request.path, "/x");
}

TEST(Target, BadEscapesAreRefused) {
    for (const char* bad : {"", "x", "/%", "/%4", "/%zz", "/%00", "/?a=%1"}) {
        EXPECT_THROW((void)parse_target(bad, "abc"), InputError) << bad;
    }
}

TEST(Token, OnlyTheSameIsTheSame) {
    EXPECT_TRUE(same_token("abc", "abc"));
    for (const char* other : {"", "ab", "abd", "abcd", "ABC"}) {
        EXPECT_FALSE(same_token(other, "abc")) << other;
    }
    EXPECT_EQ(make_token().size(), 32U);
    EXPECT_NE(make_token(), make_token());
}

TEST(Host, NamesThatMayBeAnyPagesAreRefused) {
    for (const char* good : {"localhost", "localhost:80", "127.0.0.1:9", "10.0.0.7", "[::1]:80"}) {
        EXPECT_TRUE(host_allowed(good)) << good;
    }
    for (const char* bad :
         {"", "evil.example", "evil.example:80", "localhost.evil.example",
          "127.0.0.1.evil.example:80", "localhost:x", "[::1", "localhost:80:80"}) {
        EXPECT_FALSE(host_allowed(bad)) << bad;
    }
}

TEST(Origin, OnlyTheSameServerAndThoseNamed) {
    EXPECT_TRUE(origin_allowed("", "localhost:80", {}));
    EXPECT_TRUE(origin_allowed("http://localhost:80", "localhost:80", {}));
    EXPECT_TRUE(origin_allowed("https://app.example", "localhost:80", {"https://app.example"}));
    EXPECT_FALSE(origin_allowed("http://localhost:81", "localhost:80", {}));
    EXPECT_FALSE(origin_allowed("https://app.example", "localhost:80", {}));
    const std::vector<std::string> any_port = {"http://127.0.0.1:*"};
    EXPECT_TRUE(origin_allowed("http://127.0.0.1:81", "localhost:80", any_port));
    for (const char* other : {"http://127.0.0.1", "http://127.0.0.1:", "https://127.0.0.1:81",
                              "http://127.0.0.1:8.evil.example",
                              "http://127.0.0.1:81@evil.example:82", "http://evil.example:81"}) {
        EXPECT_FALSE(origin_allowed(other, "localhost:80", any_port)) << other;
    }
    EXPECT_FALSE(origin_allowed("null", "localhost:80", {"https://app.example"}));
}

}  // namespace
