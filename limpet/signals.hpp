// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The words that stations of a flight exchange: frames and units (frames.hpp), what is true, what
/// sensors say, what the autopilot believes, what guidance asks for, what happened and how it
/// ended. Frames are north-east-down (W) and forward-right-down (B); units are SI and in the names.
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/signals/cup_status.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/core/signals/true_end.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
