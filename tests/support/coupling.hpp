// Couplings of contacts for tests, all of whose rows are known.
#pragma once

#include "core/union_find.hpp"
#include "solve/impulses.hpp"

namespace frond::test {

// Makes a table of rows, which must outlive it.
inline CouplingTable coupling_table(const std::vector<std::vector<Coupling>>& rows) {
    CouplingTable table;
    table.row = [&rows](int i) -> const std::vector<Coupling>& { return rows[size_t(i)]; };
    UnionFind sets(rows.size());
    for (size_t i = 0; i < rows.size(); i++)
        for (const Coupling& c : rows[i]) sets.join(int(i), c.other);
    table.islands = sets.sets();
    return table;
}

}  // namespace frond::test
