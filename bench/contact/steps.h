#pragma once

namespace hovercraft::bench {

/// A craft in a pen, and far obstacles, against a step without a world.
void stepCost();
/// A craft 3 mm over a floor, against one without the floor.
void hoverCost();
/// A craft pressed against a wall, or on a floor, against one without it.
void pressedCost();
/// Stacks of boxes, and a cube of 27.
void stackCost();

}  // namespace hovercraft::bench
