// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

/* The loops of roller_sim_ros/drum_soil in plain C: what the same algorithm costs without Python.

   Written from the equations and the phases, sample by sample: exciter, parabolic part of a step, phase changes located
   inside the step, fresh-soil rule. The arrays are those of the kernels in drum_soil, so that both can be given the
   same ones; reference_loop.py compiles and calls it, kernel.py checks that both give the same samples. */

#include "reference_phases.h"

static inline Model model_of(const double *constants) {
    Model m = {.h = constants[STEP],
               .omega = constants[OMEGA],
               .mass = constants[MASS],
               .inverse_mass = 1.0 / constants[MASS],
               .load = constants[STATIC_LOAD],
               .plastic = constants[PLASTIC_COMPLIANCE],
               .rate = constants[VERTICAL_SINE] * constants[ACCELERATION_RATE],
               .compliance = constants[STATIC_COMPLIANCE]};
    return m;
}

static inline State state_of(const double *state) {
    State s = {state[DEPTH],   state[VELOCITY], state[FORCE], state[SURFACE], state[SURFACE_VELOCITY],
               state[PLASTIC], state[DATUM]};
    return s;
}

static inline void keep(double *state, const State *s, int phase, long unsettled_steps) {
    state[DEPTH] = s->d;
    state[VELOCITY] = s->v;
    state[FORCE] = s->force;
    state[SURFACE] = s->e;
    state[SURFACE_VELOCITY] = s->w;
    state[PLASTIC] = s->q;
    state[DATUM] = s->datum;
    state[PHASE] = phase;
    state[UNSETTLED_STEPS] += (double)unsettled_steps;
}

static inline void write_sample(double *out, long samples, long i, const double *constants, double total, double sine,
                                double cosine, const Model *m, const State *s, int phase) {
    out[i] = constants[VERTICAL_SINE] * total * sine + (s->force - m->load) * m->inverse_mass;
    out[samples + i] = total * (constants[HORIZONTAL_SINE] * sine + constants[HORIZONTAL_COSINE] * cosine);
    out[2 * samples + i] = s->force;
    out[3 * samples + i] = s->d;
    out[4 * samples + i] = s->e;
    out[5 * samples + i] = s->q;
    out[6 * samples + i] = s->datum;
    out[7 * samples + i] = phase;
}

static inline State moved_on(const Model *m, const State *s, const Result *r, int phase) {
    State next = {r->d, r->v, r->force, r->e, r->w, s->q, s->datum};
    if (phase == LOADING)
        next.q += m->plastic * (r->force - s->force);
    return next;
}

void two_pole(long samples, long first, double *state, const double *constants, const double *sine,
              const double *cosine, double *out) {
    Model m = model_of(constants);
    m.two_pole = true;
    m.natural = constants[NATURAL_FREQUENCY];
    m.quality = constants[QUALITY];
    Motion motion_y = two_pole_motion(&m, 0.5 * m.h), motion = two_pole_motion(&m, m.h);
    Answer at_y = two_pole_answer(&m, 0.5 * m.h, &motion_y), at = two_pole_answer(&m, m.h, &motion);
    Joint joint = joint_over(&m, m.h);
    Turn half = turn_over(0.5 * m.h, m.omega), whole = turn_over(m.h, m.omega);
    State s = state_of(state);
    int phase = (int)state[PHASE];
    long unsettled_steps = 0;
    Split split;
    for (long i = 0, j = first; i < samples; i++, j++) {
        double total = constants[START_ACCELERATION] + constants[ACCELERATION_RATE] * ((double)j * m.h);
        double amplitude = constants[VERTICAL_SINE] * total;
        write_sample(out, samples, i, constants, total, sine[j], cosine[j], &m, &s, phase);
        Result r;
        bool changes;
        if (phase == UNLOADING) {
            r = joint_part(&m, &joint, &s, sine[j], cosine[j], amplitude);
            changes = r.slope_end > STILL_SLOPE || r.force < 0.0;
        } else {
            r = solve_part(&m, phase, m.h, true, &s, 0.0, exciter_motion(&half, sine[j], cosine[j], amplitude, m.rate),
                           exciter_motion(&whole, sine[j], cosine[j], amplitude, m.rate),
                           two_pole_free(&m, &s, &motion_y), two_pole_free(&m, &s, &motion), at_y, at);
            if (phase == LOADING)
                changes = r.v < r.w - STILL_VELOCITY || r.slope_start + r.slope_end < -STILL_SLOPE;
            else
                changes = r.d > r.e + s.q + s.datum;
        }
        bool apex = s.v < 0.0 && r.v >= 0.0 && r.v - s.v > STILL_VELOCITY;
        if (changes || (apex && !(phase == AIR && r.d < r.e + s.datum))) {
            split.sine = sine[j], split.cosine = cosine[j], split.amplitude = amplitude;
            phase = split_step(&m, &split, phase, &s, r, &unsettled_steps);
        } else {
            s = moved_on(&m, &s, &r, phase);
            if (apex)
                renew(&m, &s, AIR);
        }
    }
    keep(state, &s, phase, unsettled_steps);
}

static void add_bend(double *restrict free, double *restrict free_rate, long memory, const double *restrict ramp_2,
                     const double *restrict ramp, const double *restrict step, double h, Bend bend) {
    double v = bend.time / h, u = 1.0 - v;
    double h00 = (1.0 + 2.0 * u) * v * v, h01 = u * u * (3.0 - 2.0 * u), h10 = u * v * v * h, h11 = -u * u * v * h;
    double r01 = 6.0 * u * v / h, r10 = v * (1.0 - 3.0 * u), r11 = u * (3.0 * u - 2.0);
    for (long k = 0; k < memory; k++) {
        double ramp_u = h00 * ramp[k] + h01 * ramp[k + 1] + h10 * step[k] + h11 * step[k + 1];
        double ramp_2_u = h00 * ramp_2[k] + h01 * ramp_2[k + 1] + h10 * ramp[k] + h11 * ramp[k + 1];
        double step_u = r01 * (ramp[k + 1] - ramp[k]) + r10 * step[k] + r11 * step[k + 1];
        free[k] += bend.slope * ramp_u + bend.curvature * ramp_2_u;
        free_rate[k] += bend.slope * step_u + bend.curvature * ramp_u;
    }
}

static inline void add_chord(double *restrict free, double *restrict free_rate, long memory, double change,
                             double bulge, double kappa, const double *restrict chord,
                             const double *restrict chord_rate, const double *restrict bulge_rate) {
    for (long k = 0; k < memory; k++) {
        free[k] += change * chord[k] + bulge * chord_rate[k];
        free_rate[k] += change * chord_rate[k] + kappa * bulge_rate[k];
    }
}

void exact(long samples, long first, double *state, const double *constants, const double *sine, const double *cosine,
           long memory, const double *middle, const double *ramp_2, const double *ramp, const double *step,
           const double *chord, const double *chord_rate, const double *bulge_rate, double *free, double *free_rate,
           double *out) {
    Model m = model_of(constants);
    m.ramp_h = ramp[1];
    m.step_h = step[1];
    double h = m.h, bulge = h * h * h / 6.0;
    Answer at_y = {middle[0], middle[1], middle[2]}, at = {ramp_2[1], ramp[1], step[1]};
    Turn half = turn_over(0.5 * h, m.omega), whole = turn_over(h, m.omega);
    State s = state_of(state);
    int phase = (int)state[PHASE];
    long unsettled_steps = 0;
    Split split;
    for (long i = 0, j = first; i < samples; i++, j++) {
        double total = constants[START_ACCELERATION] + constants[ACCELERATION_RATE] * ((double)j * h);
        double amplitude = constants[VERTICAL_SINE] * total;
        write_sample(out, samples, i, constants, total, sine[j], cosine[j], &m, &s, phase);
        double e_1 = free[i + 1], w_1 = free_rate[i + 1], e_2 = free[i + 2], w_2 = free_rate[i + 2], rise = e_1 - s.e;
        double a = 0.25 * (e_2 - s.e + 4.0 * rise - h * (2.0 * s.w + 4.0 * w_1));
        double b = 0.25 * (h * w_2 - (-12.0 * rise + h * (5.0 * s.w + 8.0 * w_1)) - 12.0 * a);
        Known known = {e_1, w_1};
        Known known_y = {0.5 * (s.e + e_1) + 0.125 * h * (s.w - w_1) + 0.0625 * (a - 1.5 * b),
                         1.5 * rise / h - 0.25 * (s.w + w_1) + 0.0625 * b / h};
        Result r = solve_part(&m, phase, h, true, &s, 0.0, exciter_motion(&half, sine[j], cosine[j], amplitude, m.rate),
                              exciter_motion(&whole, sine[j], cosine[j], amplitude, m.rate), known_y, known, at_y, at);
        bool changes;
        if (phase == LOADING)
            changes = r.slope_start + r.slope_end < -STILL_SLOPE || r.v < r.w - STILL_VELOCITY;
        else if (phase == UNLOADING)
            changes = r.slope_end > STILL_SLOPE || r.force < 0.0;
        else
            changes = r.d > r.e + s.q + s.datum;
        bool apex = s.v < 0.0 && r.v >= 0.0 && r.v - s.v > STILL_VELOCITY;
        double *next = free + i + 1, *next_rate = free_rate + i + 1, force_0 = s.force;
        next[memory] = m.compliance * force_0;
        next_rate[memory] = 0.0;
        if (changes || (apex && !(phase == AIR && r.d < r.e + s.datum))) {
            split.sine = sine[j], split.cosine = cosine[j], split.amplitude = amplitude;
            split.e_0 = s.e, split.w_0 = s.w, split.e_1 = e_1, split.w_1 = w_1, split.a = a, split.b = b;
            phase = split_step(&m, &split, phase, &s, r, &unsettled_steps);
            for (int n = 0; n < split.count; n++)
                add_bend(next, next_rate, memory, ramp_2, ramp, step, h, split.bends[n]);
        } else {
            s = moved_on(&m, &s, &r, phase);
            if (phase == UNLOADING)
                s.q = s.d - s.e - s.datum;
            else if (phase == AIR && apex)
                renew(&m, &s, AIR);
            if (phase != AIR) {
                double kappa = (r.slope_start - r.slope_end) / (2.0 * h);
                add_chord(next, next_rate, memory, s.force - force_0, bulge * kappa, kappa, chord, chord_rate,
                          bulge_rate);
            }
        }
        next[memory] += (s.force - force_0) * m.compliance;
    }
    for (long k = 0; k <= memory; k++) {
        free[k] = free[samples + k];
        free_rate[k] = free_rate[samples + k];
    }
    keep(state, &s, phase, unsettled_steps);
}
