// SPDX-License-Identifier: Apache-2.0
// Reloads a page that is rewritten while it is shown (wavetracer serve --page). The user's choices are kept: the
// camera, colours, and what is shown.
"use strict";

const kept_choices = ["colour", "quantity", "rays_by"];
const kept_name = "wavetracer " + location.pathname;

function keep_view() {
  const {target, distance, azimuth, elevation} = orbit;
  const choices = Object.fromEntries(kept_choices.map((name) => [name, control(name).value]));
  const toggles = Object.fromEntries([...control("toggles").querySelectorAll("input")].map(({id, checked}) => [id, checked]));
  sessionStorage.setItem(kept_name, JSON.stringify({target: target.toArray(), distance, azimuth, elevation, choices, toggles}));
}

// Returns false if nothing was stored.
function restore_view() {
  const text = meta.reload_s ? sessionStorage.getItem(kept_name) : null;
  if (!text) return false;
  const {target, distance, azimuth, elevation, choices, toggles} = JSON.parse(text);
  orbit.target.fromArray(target);
  Object.assign(orbit, {distance, azimuth, elevation});
  orbit.apply();
  for (const [name, value] of Object.entries(choices))
    if ([...control(name).options].some((option) => option.value === value)) control(name).value = value;
  for (const [name, checked] of Object.entries(toggles)) if (control(name)) control(name).checked = checked;
  return true;
}

// It waits while something is being dragged.
function reload_later() {
  if (!meta.reload_s) return;
  setTimeout(() => {
    if (orbit.pointers.size) return reload_later();
    keep_view();
    location.reload();
  }, 1000 * meta.reload_s);
}
