// Workspaces are lent to one call at a time and used again, also after the thread that used them has ended.
#include "core/borrowed.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace frond::test {
namespace borrowed_tests {

struct Room {
    std::vector<int> numbers;
};

TEST(BorrowedWorkspaces, AreLentToOneAtATime) {
    Borrowed<Room> first, second;
    EXPECT_NE(&*first, &*second);
}

TEST(BorrowedWorkspaces, OutliveTheThreadThatUsedThem) {
    const Room* used = nullptr;
    std::thread other([&used] {
        Borrowed<Room> room;
        room->numbers.assign(3, 7);
        used = &*room;
    });
    other.join();
    Borrowed<Room> room;
    EXPECT_EQ(&*room, used);
    EXPECT_EQ(room->numbers, std::vector<int>(3, 7));
}

}  // namespace borrowed_tests
}  // namespace frond::test
