// CoupledRows: the rows of an island, and how an impulse at one of them moves the others.
#pragma once

#include "contact/contact_rows.hpp"
#include "contact/touched_plant.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Returns whether both rows push one movable body.
bool are_one_body(const ContactRow& a, const ContactRow& b);

class CoupledRows {
public:
    // Drops rows of plants that have no compliance. `touched`: by the plants' numbers; outlives this.
    CoupledRows(std::vector<ContactRow> rows, size_t plant_count, std::vector<TouchedPlant>& touched);
    CoupledRows(const CoupledRows&) = delete;
    CoupledRows& operator=(const CoupledRows&) = delete;
    const std::vector<ContactRow>& rows() const { return _rows; }
    std::vector<Touch> touches() const;
    // One island of all rows, whose couplings are computed on request. It refers to this.
    CouplingTable table() const;

    // Returns the parts of a link's impulse, with their work on plants as these give way to the loads of all links of
    // the body. Of other bodies' links any proportion may push, so that the link's own counts for more, as in mass
    // splitting (Tonge and others 2012).
    std::vector<Foreseen::Part> parts_with_gives(size_t row, const std::vector<Vec3>& impulses) const;

private:
    // Sides of rows that are one plant's: as a row's first plant, or with the opposite sign as its second.
    struct Sides {
        std::vector<int> rows;
        std::vector<double> signs;
        std::vector<size_t> places;  // among the plant's touches
    };
    void find_touches();
    void sort_by_plant();
    void couple_by_plants(int by, std::vector<Coupling>& row) const;
    const std::vector<Coupling>& couple(int by) const;

    std::vector<ContactRow> _rows;
    std::vector<TouchedPlant>& _touched;
    std::vector<Sides> _plants;  // by PlantBody::place
    mutable std::vector<std::vector<Coupling>> _known;
};

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
