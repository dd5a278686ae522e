#include "commands/hazards.h"

#include "language/compat.h"

namespace diptych::core {
namespace {

template <class Enum>
std::size_t place(Enum value) {
    return static_cast<std::size_t>(value);
}

bool conflict(Effect earlier, Effect later) {
    if (MUTANT(WRITE_AFTER_READ_UNORDERED, false, earlier == Effect::read)) {
        return false;
    }
    return (earlier != Effect::read || later != Effect::read) && (earlier != Effect::append || later != Effect::append);
}

}  // namespace

std::optional<Barrier> Hazards::next(std::span<const Use> uses) {
    Barrier barrier;
    for (const Use& use : uses) {
        const Barrier own = needed(use);
        barrier.before |= own.before;
        barrier.after |= own.after;
    }
    if (barrier.before != 0) {
        order(barrier);
    }
    // Work ordered after a write is also ordered after everything that the write waited for.
    for (const Use& use : uses) {
        if (use.effect == Effect::write) {
            marks_[place(use.resource)] = {};
        }
    }
    for (const Use& use : uses) {
        marks_[place(use.resource)][place(use.effect)][place(use.unit)] = {.present = true};
    }
    return barrier.before != 0 ? std::optional(barrier) : std::nullopt;
}

Barrier Hazards::needed(const Use& use) const {
    Barrier barrier;
    const Marks& marks = marks_[place(use.resource)];
    for (std::size_t effect = 0; effect < marks.size(); ++effect) {
        for (std::size_t unit = 0; unit < marks[effect].size(); ++unit) {
            const Mark& mark = marks[effect][unit];
            if (mark.present && conflict(static_cast<Effect>(effect), use.effect) &&
                (mark.ordered & bit(use.unit)) == 0) {
                barrier.before |= bit(static_cast<Unit>(unit));
                barrier.after |= bit(use.unit);
            }
        }
    }
    return barrier;
}

void Hazards::order(const Barrier& barrier) {
    for (Marks& marks : marks_) {
        for (auto& of_effect : marks) {
            for (std::size_t unit = 0; unit < of_effect.size(); ++unit) {
                if ((barrier.before & bit(static_cast<Unit>(unit))) != 0) {
                    of_effect[unit].ordered |= barrier.after;
                }
            }
        }
    }
}

}  // namespace diptych::core
