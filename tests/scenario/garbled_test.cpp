// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/core/random.hpp"
#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

// Whatever the text: it loads, or it is refused in one line. Nothing else, and no crash.

class Garbled : public ::testing::Test {
protected:
    void expect_loads_or_is_refused(const std::string& text) const {
        try {
            static_cast<void>(data_.load_text(text));
        } catch (const InputError& error) {
            const std::string what = error.what();
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            EXPECT_EQ(what.rfind("x.yaml:", 0), 0U) << what;
        }
    }
    TestData data_;
};

TEST_F(Garbled, CutAnywhere) {
    const std::string text = to_yaml(data_.load("first", {"wall.first_touches=[glass]"}));
    for (std::size_t size = 0; size < text.size(); size += 7) {
        expect_loads_or_is_refused(text.substr(0, size));
    }
}

TEST_F(Garbled, CharactersReplaced) {
    const std::string text =
        "description: \"a\"\nmission: perch\nvehicle: {base: small, mass_kg: 2.1}\n"
        "wall:\n  surface: stone\n  first_touches: [glass, stone]\nseed: 3\n"
        "guidance: {hold_s: 0.5}\nsuction:\n  valve_fitted: true\n";
    const std::string alphabet = "{}[]:,-?!&*#|>%@`'\"\\ \n\t.0123456789eabc~";
    RandomStream random(1, 0, Stream::test);
    const auto pick = [&](std::size_t size) {
        return static_cast<std::size_t>(random.uniform() * static_cast<double>(size));
    };
    for (int i = 0; i < 3000; ++i) {
        std::string garbled = text;
        for (std::size_t n = 1 + pick(4); n > 0; --n) {
            garbled[pick(garbled.size())] = alphabet[pick(alphabet.size())];
        }
        SCOPED_TRACE(garbled);
        expect_loads_or_is_refused(garbled);
    }
}

}  // namespace
}  // namespace limpet::scenario
