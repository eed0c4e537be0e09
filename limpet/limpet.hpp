// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Limpet, a multirotor that perches on walls with a suction cup: all that a program of your own
/// includes. docs/examples/ begins with five lines that fly; from there
///
///   scenario.hpp   load what to fly, change keys
///   flight.hpp     fly it, step it, save and branch it, put stations of your own in its loop
///   signals.hpp    what the stations tell each other; frames, units, errors
///   autopilot.hpp guidance.hpp cup.hpp plant.hpp   the stations that you may bring
///   recording.hpp  read what was flown
///   version.hpp    what may change when
///
/// Bad input throws InputError, one line that says where, what and what is allowed instead. Flights
/// in several threads need nothing from each other; one flight belongs to one thread.
#include "limpet/autopilot.hpp"
#include "limpet/cup.hpp"
#include "limpet/flight.hpp"
#include "limpet/guidance.hpp"
#include "limpet/plant.hpp"
#include "limpet/recording.hpp"
#include "limpet/scenario.hpp"
#include "limpet/signals.hpp"
#include "limpet/version.hpp"
