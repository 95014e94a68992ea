quad_params = {
    'mass': 0.03,
    'rotor_pos': {'r1': [1, 2, 3],
