// In: a pattern of blocks. Out: its fronts, and the places of all data in them.
//
// Nodes with the same rows form a front. A plant is thin, so its fronts are small and their overhead would cost more
// than arithmetic: a front is merged into its parent wherever the merged one is estimated to be cheaper than both,
// though it then has zeros (Ashcraft, Grimes 1989, "The influence of relaxed supernode partitions on the multifrontal
// method").
#include <algorithm>

#include "core/assert.hpp"
#include "solve/elimination_order.hpp"
#include "solve/fronts.hpp"

namespace frond {

namespace {

// A front under construction; nodes are given by their places in the initial elimination order.
struct Draft {
    std::vector<int> own, rows;  // ascending
    std::vector<int> children;
    int parent = -1;
    bool is_merged = false;
};

// Returns the rows of each column below the diagonal: those of the matrix and those of its child columns.
std::vector<std::vector<int>> columns_of_factor(const BlockPattern& pattern, const std::vector<int>& place) {
    std::vector<std::vector<int>> columns(place.size());
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int a = place[size_t(pattern.row[size_t(k)])], b = place[size_t(j)];
            if (a != b) columns[size_t(std::min(a, b))].push_back(std::max(a, b));
        }
    for (std::vector<int>& rows : columns) {
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        if (rows.empty()) continue;
        std::vector<int>& parent = columns[size_t(rows.front())];
        parent.insert(parent.end(), rows.begin() + 1, rows.end());
    }
    return columns;
}

// Returns the estimated time of a front [ns]: fixed, for its numbers, for adding its update, and for arithmetic.
double cost_of(size_t own_nodes, size_t row_nodes) {
    const double own = 3 * double(own_nodes), rows = 3 * double(row_nodes), all = own + rows;
    return 200 + 0.15 * all * all + 0.15 * rows * rows + 0.1 * own * all * all;
}

// Makes each column a draft and merges drafts upwards.
std::vector<Draft> draft_fronts(const std::vector<std::vector<int>>& columns) {
    std::vector<Draft> drafts(columns.size());
    for (size_t j = 0; j < columns.size(); ++j) {
        Draft& draft = drafts[j];
        draft.own = {int(j)};
        draft.rows = columns[j];
        if (draft.rows.empty()) continue;
        draft.parent = draft.rows.front();
        drafts[size_t(draft.parent)].children.push_back(int(j));
    }
    for (Draft& parent : drafts) {
        // Children with the most rows cause the least fill.
        std::vector<int> children = std::move(parent.children);
        parent.children.clear();
        std::sort(children.begin(), children.end(), [&](int a, int b) {
            const size_t rows_a = drafts[size_t(a)].rows.size(), rows_b = drafts[size_t(b)].rows.size();
            return rows_a != rows_b ? rows_a > rows_b : a < b;
        });
        for (const int c : children) {
            Draft& child = drafts[size_t(c)];
            const double apart =
                cost_of(child.own.size(), child.rows.size()) + cost_of(parent.own.size(), parent.rows.size());
            if (cost_of(child.own.size() + parent.own.size(), parent.rows.size()) >= apart) {
                parent.children.push_back(c);
                continue;
            }
            child.is_merged = true;
            parent.own.insert(parent.own.end(), child.own.begin(), child.own.end());
            parent.children.insert(parent.children.end(), child.children.begin(), child.children.end());
        }
        std::sort(parent.own.begin(), parent.own.end());
    }
    return drafts;
}

// Returns the fronts with children before parents, and each front's descendants right before it.
std::vector<int> after_children(const std::vector<Draft>& drafts) {
    std::vector<int> order, open;
    for (size_t root = drafts.size(); root-- > 0;)
        if (!drafts[root].is_merged && drafts[root].parent < 0) open.push_back(int(root));
    // Parents first, then reversed; without recursion, since a plant may be deeper than the call stack.
    while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        order.push_back(at);
        open.insert(open.end(), drafts[size_t(at)].children.begin(), drafts[size_t(at)].children.end());
    }
    std::reverse(order.begin(), order.end());
    return order;
}

int node_in_front(const FrontPlan& plan, const Front& front, int place) {
    if (place < front.first + front.own) return place - front.first;
    const auto begin = plan.rows.begin() + front.row, end = begin + front.rows;
    return front.own + int(std::lower_bound(begin, end, place) - begin);
}

// Returns the row of a front's node in its columns.
int row_of(const Front& front, int node) {
    return node < front.own ? 3 * node : padded(front.own) + 3 * (node - front.own);
}

void place_entries(const BlockPattern& pattern, FrontPlan& plan) {
    std::vector<std::vector<FrontPlan::Entry>> of(plan.fronts.size());
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int a = plan.place[size_t(pattern.row[size_t(k)])], b = plan.place[size_t(j)];
            const int column = std::min(a, b), f = plan.front_of[size_t(column)];
            const Front& front = plan.fronts[size_t(f)];
            const int to = row_of(front, node_in_front(plan, front, std::max(a, b))) +
                           stride_of(front) * 3 * (column - front.first);
            of[size_t(f)].push_back({k, to, a < b});
        }
    for (size_t f = 0; f < of.size(); ++f) {
        plan.fronts[f].entry = int(plan.entries.size());
        plan.fronts[f].entries = int(of[f].size());
        plan.entries.insert(plan.entries.end(), of[f].begin(), of[f].end());
    }
}

void place_rows(FrontPlan& plan) {
    for (const Front& front : plan.fronts)
        for (int k = 0; k < front.rows; ++k)
            plan.landings.push_back(
                {node_in_front(plan, plan.fronts[size_t(front.parent)], plan.rows[size_t(front.row + k)]), 1});
    for (const Front& front : plan.fronts)
        for (int k = front.rows - 2; k >= 0; --k) {
            FrontPlan::Landing& here = plan.landings[size_t(front.row + k)];
            const FrontPlan::Landing& next = plan.landings[size_t(front.row + k) + 1];
            const bool follows = next.to == here.to + 1 && next.to != plan.fronts[size_t(front.parent)].own;
            if (follows) here.count = next.count + 1;
        }
}

// Places updates on two stacks, for fronts an even and an odd number of generations away from the root, so that a
// front's update never overlaps its children's.
void place_numbers(FrontPlan& plan) {
    std::vector<uint8_t> is_odd(plan.fronts.size(), 0);
    for (size_t f = plan.fronts.size(); f-- > 0;)
        if (plan.fronts[f].parent >= 0) is_odd[f] = !is_odd[size_t(plan.fronts[f].parent)];
    size_t top[2] = {0, 0}, highest[2] = {0, 0};
    for (size_t f = 0; f < plan.fronts.size(); ++f) {
        Front& front = plan.fronts[f];
        front.columns = plan.column_size;
        const size_t columns = size_t(stride_of(front)) * size_t(3 * front.own);
        plan.column_size += columns;
        plan.largest = std::max(plan.largest, columns);
        plan.longest = std::max(plan.longest, size_t(stride_of(front)));
        // The children's updates are on top of the other stack.
        size_t& others = top[!is_odd[f]];
        for (int c = 0; c < front.children; ++c)
            others = std::min(others, plan.fronts[size_t(plan.children[size_t(front.child + c)])].update);
        size_t& own = top[is_odd[f]];
        front.update = own;
        own += size_t(padded(front.rows)) * size_t(3 * front.rows);
        highest[is_odd[f]] = std::max(highest[is_odd[f]], own);
    }
    for (size_t f = 0; f < plan.fronts.size(); ++f)
        if (is_odd[f]) plan.fronts[f].update += highest[0];
    plan.update_size = highest[0] + highest[1];
}

}  // namespace

FrontPlan make_front_plan(const BlockPattern& pattern) {
    FrontPlan plan;
    const std::vector<int> first_order = elimination_order(pattern);
    std::vector<int> first_place(first_order.size());
    for (size_t k = 0; k < first_order.size(); ++k) first_place[size_t(first_order[k])] = int(k);
    const std::vector<Draft> drafts = draft_fronts(columns_of_factor(pattern, first_place));

    const std::vector<int> order = after_children(drafts);
    std::vector<int> front_at(drafts.size(), -1), place(drafts.size());
    plan.place.resize(drafts.size());
    for (const int at : order) {
        const Draft& draft = drafts[size_t(at)];
        front_at[size_t(at)] = int(plan.fronts.size());
        Front front = {};
        front.first = int(plan.order.size());
        front.own = int(draft.own.size());
        front.rows = int(draft.rows.size());
        front.child = int(plan.children.size());
        front.children = int(draft.children.size());
        for (const int child : draft.children) {
            FROND_ASSERT(front_at[size_t(child)] >= 0);
            plan.children.push_back(front_at[size_t(child)]);
        }
        for (const int j : draft.own) {
            const int node = first_order[size_t(j)];
            place[size_t(j)] = plan.place[size_t(node)] = int(plan.order.size());
            plan.order.push_back(node);
            plan.front_of.push_back(int(plan.fronts.size()));
        }
        plan.fronts.push_back(front);
    }
    for (size_t f = 0; f < order.size(); ++f) {
        Front& front = plan.fronts[f];
        front.row = int(plan.rows.size());
        for (const int j : drafts[size_t(order[f])].rows) plan.rows.push_back(place[size_t(j)]);
        std::sort(plan.rows.begin() + front.row, plan.rows.end());
        front.parent = front.rows == 0 ? -1 : plan.front_of[size_t(plan.rows[size_t(front.row)])];
        FROND_ASSERT(front.parent < 0 || front.parent > int(f));
    }
    FROND_ASSERT(plan.order.size() == size_t(pattern.node_count));
    place_rows(plan);
    place_entries(pattern, plan);
    place_numbers(plan);
    return plan;
}

}  // namespace frond
