// The same plants drawn otherwise have the same organs.
#include <gtest/gtest.h>

#include <cstdio>

#include "changes.hpp"
#include "corpus.hpp"
#include "io/import.hpp"

namespace frond::test {

class Variants : public testing::TestWithParam<int> {};

TEST_P(Variants, HaveTheSameOrgans) {
    const Variant& one = variants()[size_t(GetParam())];
    for (bool bare : {false, true}) {
        double kinds = 0, leaves = 0;
        const std::vector<Row> rows = read_seen();
        for (const Row& row : rows) {
            std::mt19937 random(7);
            Surface surface = load(row, bare);
            one.change(surface, random);
            surface.placed = false;
            place_surface(surface, {1, Vec3::UnitY(), {}, ""});
            const Score score = compare(row, find(row, std::move(surface)).counts);
            kinds += double(score.right) / std::max(1, score.all) / double(rows.size());
            leaves += double(score.leaves) / double(rows.size());
        }
        std::printf("%s, %s: kinds right %.3f, count of leaves %.3f\n", one.name, bare ? "bare" : "as they are", kinds,
                    leaves);
        EXPECT_GT(kinds, one.kinds);
        EXPECT_GT(leaves, one.leaves);
    }
}

INSTANTIATE_TEST_SUITE_P(Corpus, Variants, testing::Range(0, int(variants().size())),
                         [](const auto& info) { return std::string(variants()[size_t(info.param)].name); });

}  // namespace frond::test
