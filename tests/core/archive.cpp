// Archives: what was written is read again; bytes that end early, name too much or choose what is not are refused.
#include "core/archive.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace frond {
namespace archive_tests {

struct Leaf {
    bool open = false;
    std::string name;
    std::array<int16_t, 3> corner = {};
};
struct Tree {
    double height = 0;
    std::vector<Leaf> leaves;
    std::vector<Vec3> places;
    std::vector<std::array<int, 2>> links;
    VecX state;
    std::vector<uint8_t> bytes;
    frond_mechanics mechanics = FROND_MECHANICS_ROD;
};
void visit(Archive& a, Leaf& leaf) {
    auto& [open, name, corner] = leaf;
    a(open, name, corner);
}
void visit(Archive& a, Tree& tree) {
    auto& [height, leaves, places, links, state, bytes, mechanics] = tree;
    a(height, leaves, places, links, state, bytes);
    a.one_of(mechanics, FROND_MECHANICS_COUNT);
}

Tree some_tree() {
    return {1.5,       {{true, "a", {1, -2, 3}}, {}}, {Vec3(1, 2, 3)}, {{4, 5}, {6, 7}}, VecX::Ones(3),
            {9, 8, 7}, FROND_MECHANICS_TET_LINEAR};
}
std::vector<uint8_t> bytes_of(Tree tree) {
    Archive archive;
    archive(tree);
    return archive.out;
}
Tree read(const std::vector<uint8_t>& bytes) {
    Archive archive(bytes.data(), bytes.size(), {"the tree", "grow it anew"});
    Tree tree;
    archive(tree);
    EXPECT_TRUE(archive.is_at_end());
    return tree;
}

TEST(Archives, ReadWhatTheyWrote) {
    const std::vector<uint8_t> bytes = bytes_of(some_tree());
    const Tree tree = read(bytes);
    EXPECT_EQ(bytes_of(tree), bytes);
    EXPECT_EQ(tree.leaves[0].name, "a");
    EXPECT_TRUE(tree.leaves[0].open);
    EXPECT_EQ(tree.leaves[0].corner[1], -2);
    EXPECT_EQ(tree.links[1][0], 6);
    EXPECT_EQ(tree.mechanics, FROND_MECHANICS_TET_LINEAR);
}

TEST(Archives, AreLittleEndian) {
    Archive archive;
    uint32_t number = 0x01020304;
    double one = 1;
    archive(number, one);
    EXPECT_EQ(archive.out, (std::vector<uint8_t>{4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f}));
    reverse_each(archive.out.data(), 4, 3);
    EXPECT_EQ(archive.out, (std::vector<uint8_t>{1, 2, 3, 4, 0, 0, 0, 0, 0x3f, 0xf0, 0, 0}));
}

TEST(Archives, RefuseBytesThatEndEarly) {
    const std::vector<uint8_t> bytes = bytes_of(some_tree());
    for (size_t size = 0; size < bytes.size(); size++)
        EXPECT_THROW(read(std::vector<uint8_t>(bytes.begin(), bytes.begin() + long(size))), Error) << size;
}

TEST(Archives, RefuseCountsBeforeTheyAskForMemory) {
    std::vector<uint8_t> bytes = bytes_of({});
    for (size_t i = 8; i < 16; i++) bytes[i] = 0xff;  // the number of leaves
    EXPECT_THROW(read(bytes), Error);
}

TEST(Archives, RefuseUnknownChoices) {
    std::vector<uint8_t> bytes = bytes_of(some_tree());
    bytes[bytes.size() - 4] = 100;
    EXPECT_THROW(read(bytes), Error);
}

TEST(Archives, DescribeTypesAlone) {
    Archive archive = Archive::of_types();
    Tree tree = some_tree();
    archive(tree.height, tree.leaves, tree.places, tree.state);
    EXPECT_EQ(std::string(archive.out.begin(), archive.out.end()), "f8[u1[i1]i2i2i2][f8f8f8][f8]");
}

TEST(Checksums, ChangeWithEveryBit) {
    std::vector<uint8_t> bytes(21, 5);
    const uint64_t whole = checksum_of(bytes.data(), bytes.size()),
                   quick = checksum_by_words(bytes.data(), bytes.size());
    for (size_t bit = 0; bit < 8 * bytes.size(); bit++) {
        bytes[bit / 8] ^= uint8_t(1 << bit % 8);
        EXPECT_NE(checksum_of(bytes.data(), bytes.size()), whole);
        EXPECT_NE(checksum_by_words(bytes.data(), bytes.size()), quick);
        bytes[bit / 8] ^= uint8_t(1 << bit % 8);
    }
    EXPECT_NE(checksum_by_words(bytes.data(), 20), quick);
}

}  // namespace archive_tests
}  // namespace frond
