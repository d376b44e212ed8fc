#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/timer.hpp"
#include "corpus.hpp"
#include "io/import.hpp"

namespace frond::test {

static const std::string FOLDER = FROND_SOURCE_DIR "/tests/corpus/";

std::vector<Row> read_seen() {
    std::vector<Row> rows;
    std::ifstream file(FOLDER + "seen.csv");
    std::string line, cell;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        Row row;
        std::getline(cells, row.file, ',');
        for (auto& range : row.counts) {
            std::getline(cells, cell, ',');
            range[0] = range[1] = std::stoi(cell);
            if (const size_t dash = cell.find('-'); dash != std::string::npos)
                range[1] = std::stoi(cell.substr(dash + 1));
        }
        std::getline(cells, cell, ',');
        row.height = std::stod(cell);
        std::getline(cells, cell, ',');
        row.mass = std::stod(cell);
        rows.push_back(row);
    }
    return rows;
}

static int seen_as(const std::string& kind) {
    if (kind == "blade") return LEAVES;
    if (kind == "stem" || kind == "branch" || kind == "peduncle") return STEMS;
    if (kind == "fruit" || kind == "root") return SOLIDS;
    if (kind == "flower") return FLOWERS;
    if (kind == "crown") return CROWNS;
    return kind == "support" ? int(SUPPORTS) : -1;
}

bool is_wanted(const Row& row) {
    const char* wanted = std::getenv("FROND_CORPUS");
    return !wanted || row.file.find(wanted) != std::string::npos;
}

std::string path_of(const Row& row) {
    return FOLDER + row.file;
}

Surface load(const Row& row, bool bare) {
    Surface surface = import_surface(path_of(row), {});
    if (bare) {
        surface.parts.assign(1, Part());
        surface.parts[0].triangle_count = int(surface.triangles.size());
        surface.textures.clear();
        surface.colors.clear();
    }
    return surface;
}

Found find(const Row& row, Surface surface) {
    Topology topology = make_topology(surface);
    const Timer timer;
    const std::vector<Organ> organs = find_organs(surface, topology);
    Found found;
    found.ms = timer.ms();
    if (std::getenv("FROND_CORPUS") && is_wanted(row))
        for (const Part& part : surface.parts) {
            const Organ& organ = organs[size_t(part.organ)];
            std::printf("    %-10s %4d triangles, %.2f sure: %s\n", organ.kind.c_str(), part.triangle_count,
                        organ.certainty, organ.why.c_str());
        }
    for (const Organ& organ : organs)
        if (const int kind = seen_as(organ.kind); kind >= 0) found.counts[size_t(kind)]++;
    const Chain chain = make_chain(surface, topology, organs, {});
    for (const ChainNode& node : chain.nodes)
        if (node.parent < 0)
            found.root = std::max(found.root, (node.position.y() - surface.lower().y()) / surface.height());
    return found;
}

Score compare(const Row& row, const std::array<int, SEEN_COUNT>& counts) {
    Score score;
    for (size_t kind = 0; kind < SEEN_COUNT; kind++) {
        const int count = counts[kind], seen = std::clamp(count, row.counts[kind][0], row.counts[kind][1]);
        score.right += std::min(seen, count);
        score.all += std::max(seen, count);
        if (kind == LEAVES) score.leaves = std::abs(count - seen) <= 0.2 * seen;
    }
    return score;
}

}  // namespace frond::test
