quad_params = {'num_rotors': 1, 'rotor_pos': {'r1': [0.1, 0.1, 0]}, 'rotor_directions': [1],
               'k_eta': 1e-6, 'k_m': 1e-8, 'tau_m': 0.05, 'rotor_speed_max': 900}
