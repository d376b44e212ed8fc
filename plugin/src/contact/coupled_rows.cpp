#include "contact/coupled_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool are_one_body(const ContactRow& a, const ContactRow& b) {
    if (a.plants[1] || b.plants[1]) return false;
    if (a.contact_body.link && b.contact_body.link)
        return a.contact_body.link->m_multiBody == b.contact_body.link->m_multiBody;
    return a.contact_body.rigid && a.contact_body.rigid == b.contact_body.rigid;
}

CoupledRows::CoupledRows(std::vector<ContactRow> rows, size_t plant_count, std::vector<TouchedPlant>& touched)
    : _rows(std::move(rows)), _touched(touched), _plants(plant_count) {
    find_touches();
    sort_by_plant();
    _known.resize(_rows.size());
}

// Finds where rows touch their plants.
void CoupledRows::find_touches() {
    const auto has_none = [&](ContactRow& row) {
        for (size_t k = 0; k < 2; k++) {
            if (!row.plants[k]) continue;
            TouchedPlant& at = _touched[size_t(row.plants[k]->number)];
            const int place = find_touch(at, *row.plants[k]->plant, row.touches[k].attachment);
            if (place < 0) return true;
            row.places[k] = size_t(place);
        }
        return false;
    };
    _rows.erase(std::remove_if(_rows.begin(), _rows.end(), has_none), _rows.end());
}

void CoupledRows::sort_by_plant() {
    for (size_t i = 0; i < _rows.size(); i++)
        for (size_t k = 0; k < 2; k++) {
            if (!_rows[i].plants[k]) continue;
            Sides& of = _plants[size_t(_rows[i].plants[k]->place)];
            of.rows.push_back(int(i));
            of.signs.push_back(k == 0 ? 1 : -1);
            of.places.push_back(_rows[i].places[k]);
        }
}

std::vector<Touch> CoupledRows::touches() const {
    std::vector<Touch> touches;
    for (const ContactRow& row : _rows) touches.push_back(row.touch);
    return touches;
}

// Adds the couplings of a row to the other rows of its plants.
void CoupledRows::couple_by_plants(int by, std::vector<Coupling>& row) const {
    const ContactRow& at = _rows[size_t(by)];
    for (size_t k = 0; k < 2; k++) {
        if (!at.plants[k]) continue;
        const Sides& sides = _plants[size_t(at.plants[k]->place)];
        const std::vector<Mat3>& compliances = compliances_to(_touched[size_t(at.plants[k]->number)], at.places[k]);
        const double sign = k == 0 ? 1 : -1;
        for (size_t i = 0; i < sides.rows.size(); i++) {
            const Mat3& compliance = compliances[sides.places[i]];
            if (!compliance.isZero(0)) row.push_back({sides.rows[i], sign * sides.signs[i] * compliance.transpose()});
        }
    }
}

const std::vector<Coupling>& CoupledRows::couple(int by) const {
    std::vector<Coupling>& row = _known[size_t(by)];
    if (!row.empty()) return row;
    couple_by_plants(by, row);
    const ContactRow& at = _rows[size_t(by)];
    for (size_t i = 0; i < _rows.size(); i++)
        if (are_one_body(at, _rows[i]))
            row.push_back({int(i), compliance_between(at.contact_body, _rows[i].contact_body)});
    if (row.empty()) row.push_back({by, Mat3::Zero()});
    return row;
}

static void add_give(const Foreseen::Load& to, double work, std::vector<Foreseen::Give>& gives) {
    if (work == 0) return;
    for (Foreseen::Give& give : gives)
        if (give.to == to) {
            give.work += work;
            return;
        }
    gives.push_back({to, work});
}

std::vector<Foreseen::Part> CoupledRows::parts_with_gives(size_t row, const std::vector<Vec3>& impulses) const {
    const ContactRow& at = _rows[row];
    std::vector<Foreseen::Part> parts = parts_of(at, impulses[row]);
    std::vector<Coupling> couplings;
    couple_by_plants(int(row), couplings);
    for (const Coupling& by : couplings) {
        const ContactRow& other = _rows[size_t(by.other)];
        if (!other.contact_body.link) continue;
        const bool is_own = are_one_body(at, other);
        for (Foreseen::Part& part : parts)
            for (const Foreseen::Part& of_other : parts_of(other, impulses[size_t(by.other)])) {
                const double work = part.impulse.dot(by.block * of_other.impulse);
                if (is_own)
                    add_give({other.contact_body.link->m_link, of_other.kind}, work, part.gives);
                else
                    add_give({at.contact_body.link->m_link, part.kind}, std::abs(work), part.gives);
            }
    }
    return parts;
}

CouplingTable CoupledRows::table() const {
    CouplingTable table;
    table.row = [this](int row) -> const std::vector<Coupling>& { return couple(row); };
    table.islands.emplace_back(_rows.size());
    std::iota(table.islands[0].begin(), table.islands[0].end(), 0);
    return table;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
